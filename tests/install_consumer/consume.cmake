# Installs a build and lets a stranger use it: cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DGENERATOR=... -P consume.cmake
# Everything happens in BUILD_DIR/install_consumer. The stranger is told nothing but where the package is.
set(work ${BUILD_DIR}/install_consumer)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${work}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${work}/build -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${work}/prefix)
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer)
