# Runs the collision benchmark on meshes of 200 triangles and checks what it writes: results.csv has the columns and rows that
# are promised, FCL gives Glissade's answers, and the page of benchmarks takes the figures up.
# Takes BENCH (the program), SOURCE_DIR (the repository) and WORK_DIR.

function(expect condition_name)
  if(NOT ${ARGN})
    message(FATAL_ERROR "Expected ${condition_name}. The program said:\n${said}\nresults.csv:\n${results}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
execute_process(COMMAND ${BENCH} --quick --only zachmann --shapes sphere,torus --triangles 200,400 --out ${WORK_DIR}
  RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0" status EQUAL 0)

file(STRINGS ${WORK_DIR}/results.csv results)
list(GET results 0 header)
expect("the header" header STREQUAL "bench,case,subject,metric,value,unit")
list(SUBLIST results 1 -1 rows)
foreach(row IN LISTS rows)
  expect("six columns, a number in the fifth: ${row}" row MATCHES "^zachmann,[^,]+,[^,]+,[^,]+,[-+.e0-9]+,[^,]+$")
endforeach()
foreach(peer fcl ode bullet cgal)
  foreach(case geomean worst)
    expect("a ratio to ${peer}" results MATCHES "zachmann,${case},glissade,ratio_to_${peer},[0-9.e+]+,x")
  endforeach()
endforeach()
foreach(case sphere-200 sphere-400 torus-200 torus-400 far-spheres)
  expect("a time of ${case}" results MATCHES "zachmann,${case},glissade,time,[0-9.e+]+,ns")
  expect("the answers of FCL in ${case}" results MATCHES "zachmann,${case},fcl,disagreements,0,1")
endforeach()

execute_process(COMMAND ${BENCH} --only hull --quick --triangles 50 --out ${WORK_DIR}/hull
  RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of hull" status EQUAL 0)
file(READ ${WORK_DIR}/hull/results.csv results)
foreach(group "" separated- touching- penetrating-)
  foreach(case geomean worst)
    expect("a ratio to libccd" results MATCHES "hull,${group}${case},glissade,ratio_to_libccd,[0-9.e+]+,x")
  endforeach()
endforeach()
if(results MATCHES "hull,[^,]+,glissade,wrong,[1-9]")
  message(FATAL_ERROR "There are wrong answers:\n${results}")
endif()

execute_process(COMMAND ${BENCH} --only nonsense --out ${WORK_DIR} RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 2 for an unknown bench" status EQUAL 2)

file(COPY ${SOURCE_DIR}/docs/benchmarks.md DESTINATION ${WORK_DIR})
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${SOURCE_DIR}/scripts/bench_report.py
  ${WORK_DIR}/results.csv ${WORK_DIR}/benchmarks.md --command "smoke test" RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of the report" status EQUAL 0)
file(READ ${WORK_DIR}/benchmarks.md page)
expect("the new section" page MATCHES "<!-- begin zachmann -->\n[^\n]*smoke test.*<!-- end zachmann -->")
expect("the prose by hand" page MATCHES "## How it is measured")
expect("the plot" EXISTS ${WORK_DIR}/images/bench_figure3.svg)
