# A stranger's `cmake -S . -B build` without any argument must give an optimised library and command.
set(work ${BUILD}/plain)
file(REMOVE_RECURSE ${work})
# Presets and habits of the caller must not leak in.
foreach(variable CXXFLAGS CMAKE_BUILD_TYPE CMAKE_GENERATOR)
  unset(ENV{${variable}})
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${work} COMMAND_ERROR_IS_FATAL ANY)
load_cache(${work} READ_WITH_PREFIX plain_ CMAKE_BUILD_TYPE CMAKE_CXX_FLAGS_RELEASE DELMESH_BUILD_APPS
           DELMESH_SANITIZE)
if(NOT plain_CMAKE_BUILD_TYPE STREQUAL "Release" OR NOT plain_CMAKE_CXX_FLAGS_RELEASE MATCHES "-O[23]"
   OR NOT plain_DELMESH_BUILD_APPS OR plain_DELMESH_SANITIZE)
  message(FATAL_ERROR "a build without arguments is not an optimised one: type '${plain_CMAKE_BUILD_TYPE}', flags "
                      "'${plain_CMAKE_CXX_FLAGS_RELEASE}', command ${plain_DELMESH_BUILD_APPS}, sanitizers "
                      "'${plain_DELMESH_SANITIZE}'")
endif()
