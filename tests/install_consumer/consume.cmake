# Installs a build and lets strangers use it: cmake -DBUILD_DIR=... -DSOURCE_DIR=... -DGENERATOR=... -P consume.cmake
# Everything happens in BUILD_DIR/install_consumer. The strangers are told nothing but where the package is; they compile
# with g++, whatever has compiled the package.
set(ENV{CXX} g++)
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
if(NOT EXISTS ${work}/prefix/share/glissade/lcmtypes/glove_state_t.lcm)
  message(FATAL_ERROR "The definitions of the messages are not installed.")
endif()
if(IS_SYMLINK ${work}/prefix/include/glissade/glissade.h)
  message(FATAL_ERROR "The header of the C interface is installed as a link to the sources.")
endif()
foreach(project contact_only everything)
  configure(${project})
  run(${CMAKE_COMMAND} --build ${work}/${project})
  execute_process(COMMAND ${work}/${project}/consumer WORKING_DIRECTORY ${work}/${project} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
configure(questions)

# The projects of README.md, docs/start.md and docs/c.md, as they stand there, and the examples.
set(ENV{CMAKE_PREFIX_PATH} ${work}/prefix)
set(ENV{CMAKE_GENERATOR} ${GENERATOR})
function(use_project_of page source name commands)
  set(project ${work}/project_of_${page})
  file(READ ${SOURCE_DIR}/../../${page} text)
  string(REGEX MATCH "```cmake\n([^`]+)```" block "${text}")
  file(CONFIGURE OUTPUT ${project}/CMakeLists.txt CONTENT "${CMAKE_MATCH_1}" @ONLY)
  file(COPY_FILE ${SOURCE_DIR}/../../examples/${source} ${project}/${name})
  execute_process(COMMAND sh -c "${commands}" WORKING_DIRECTORY ${project} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
set(build_and_run "cmake -B build && cmake --build build && build/my_program")
use_project_of(README.md 01_first_contact.cpp main.cpp "${build_and_run}")
use_project_of(docs/start.md 01_first_contact.cpp main.cpp "${build_and_run}")
use_project_of(docs/c.md 11_wall_in_c.c 11_wall_in_c.c "cmake -B build && cmake --build build && build/wall")
# The same program by pkg-config.
file(GLOB pkg_config LIST_DIRECTORIES true ${work}/prefix/lib/pkgconfig ${work}/prefix/lib/*/pkgconfig)
set(ENV{PKG_CONFIG_PATH} ${pkg_config})
run(sh -c "g++ -std=c++20 ${work}/project_of_README.md/main.cpp $(pkg-config --static --cflags --libs glissade-simulation) -o ${work}/by_pkg_config")
run(${work}/by_pkg_config)
run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/../../examples -B ${work}/examples -G ${GENERATOR}
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${work}/prefix)
run(${CMAKE_COMMAND} --build ${work}/examples)
run(${CMAKE_CTEST_COMMAND} --test-dir ${work}/examples)

# An unknown component, required: CMake ends with the sentence, which it breaks into lines.
execute_process(COMMAND ${CMAKE_COMMAND} -DREQUIRED_COMPONENT=telepathy ${work}/questions
  RESULT_VARIABLE result ERROR_VARIABLE error OUTPUT_QUIET)
string(REGEX REPLACE "[ \n]+" " " error "${error}")
if(result EQUAL 0 OR NOT error MATCHES "glissade has no component telepathy\\. Its components are realtime, geometry, ")
  message(FATAL_ERROR "Requiring an unknown component ended with ${result} and: ${error}")
endif()
