# Installs the build in BUILD, then configures, builds and runs tests/consumer against the installed tree alone.
function(must)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(work ${BUILD}/consumer)
file(REMOVE_RECURSE ${work})
must(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/prefix)
must(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${work}/build -G ${GENERATOR}
     -DCMAKE_PREFIX_PATH=${work}/prefix -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release
     -DEXAMPLES=${CMAKE_CURRENT_LIST_DIR}/../../examples -DEXPECTED_VERSION=${EXPECTED_VERSION})
must(${CMAKE_COMMAND} --build ${work}/build)

# Two obtuse triangles that see more than pi at their common edge.
file(WRITE ${work}/in.off "OFF\n4 2 0\n0 0 0\n10 0 0\n5 1 0\n5 -1 0\n3 0 1 2\n3 1 0 3\n")
must(${work}/build/consumer ${work}/in.off ${work}/out.ply)
if(NOT EXISTS ${work}/out.ply)
  message(FATAL_ERROR "the consumer wrote nothing")
endif()
must(${work}/prefix/bin/delmesh check ${work}/out.ply)
