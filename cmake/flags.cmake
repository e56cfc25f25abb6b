# One place for compiler flags. -ffp-contract=off: the same bits on every compiler and processor.
function(delmesh_flags target)
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                           -Wno-sign-conversion)
    # GCC 12 takes std::string::insert and replace of short literals for overlapping copies.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -Wno-restrict)
    endif()
    if(DELMESH_WERROR)
      target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(DELMESH_SANITIZE)
      target_compile_options(${target} PRIVATE -fsanitize=${DELMESH_SANITIZE} -fno-sanitize-recover=all
                             -fno-omit-frame-pointer)
      target_link_options(${target} PUBLIC -fsanitize=${DELMESH_SANITIZE})
    endif()
  endif()
endfunction()
