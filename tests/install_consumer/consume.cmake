# Installs a build and lets strangers use it: cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DGENERATOR=... -P consume.cmake
# Everything happens in BUILD_DIR/install_consumer. The strangers are told nothing but where the package is.
set(work ${BUILD_DIR}/install_consumer)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(configure project)
  run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/${project} -B ${work}/${project} -G ${GENERATOR}
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${work}/prefix)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${work}/prefix)
foreach(project collision_only everything)
  configure(${project})
  run(${CMAKE_COMMAND} --build ${work}/${project})
  execute_process(COMMAND ${work}/${project}/consumer WORKING_DIRECTORY ${work}/${project} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
configure(questions)

# An unknown component, required: CMake ends with the sentence, which it breaks into lines.
execute_process(COMMAND ${CMAKE_COMMAND} -DREQUIRED_COMPONENT=telepathy ${work}/questions
  RESULT_VARIABLE result ERROR_VARIABLE error OUTPUT_QUIET)
string(REGEX REPLACE "[ \n]+" " " error "${error}")
if(result EQUAL 0 OR NOT error MATCHES "glissade has no component telepathy\\. Its components are realtime, geometry, ")
  message(FATAL_ERROR "Requiring an unknown component ended with ${result} and: ${error}")
endif()
