# Runs the collision benchmark on meshes of 200 triangles and checks its output: results.csv has the promised columns and
# rows, FCL gives Glissade's answers, and the figures appear on the page of benchmarks.
# Takes BENCH (the program), SOURCE_DIR (the repository) and WORK_DIR.

function(expect condition_name)
  if(NOT ${ARGN})
    message(FATAL_ERROR "Expected ${condition_name}. The program said:\n${said}\nresults.csv:\n${results}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
execute_process(COMMAND ${BENCH} --quick --only zachmann,scene,threads --shapes sphere,torus --triangles 200,400 --out ${WORK_DIR}
  RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0" status EQUAL 0)

file(STRINGS ${WORK_DIR}/results.csv results)
list(GET results 0 header)
expect("the header" header STREQUAL "bench,case,subject,metric,value,unit")
list(SUBLIST results 1 -1 rows)
foreach(row IN LISTS rows)
  expect("six columns, a number in the fifth: ${row}" row MATCHES "^(zachmann|scene|threads),[^,]+,[^,]+,[^,]+,[-+.e0-9]+,[^,]+$")
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

foreach(case objects-10 objects-30 objects-100 through-100)
  foreach(subject glissade fcl ode bullet)
    foreach(metric us_per_frame us_per_frame_mean us_per_frame_p99)
      expect("${metric} of ${subject} in ${case}" results MATCHES "scene,${case},${subject},${metric},[0-9.e+]+,us")
    endforeach()
  endforeach()
  expect("the answers of FCL in ${case}" results MATCHES "scene,${case},fcl,disagreements,0,1")
endforeach()
foreach(metric ratio_to_best_peer mean_ratio_to_best_peer)
  expect("${metric}" results MATCHES "scene,worst,glissade,${metric},[0-9.e+]+,x")
endforeach()
expect("the cost of rest" results MATCHES "scene,rest-1000,glissade,time_by_rest-10,[0-9.e+]+,x")
foreach(case dense dense-with-pauses sparse sparse-with-pauses pairs-400)
  expect("a speedup in ${case}" results MATCHES "threads,${case},glissade-2-threads,speedup,[0-9.e+]+,x")
  expect("the same answers in ${case}" results MATCHES "threads,${case},glissade,disagreements,0,1")
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

# A block with an oblique end.
file(WRITE ${WORK_DIR}/parts/block.obj "v 0 0 0\nv 3 0 0\nv 4 1 0\nv 0 1 0\nv 0 0 1\nv 3 0 1\nv 5 1 1\nv 0 1 1\n"
  "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
execute_process(COMMAND ${BENCH} --only parts --quick --mesh ${WORK_DIR}/parts/block.obj --out ${WORK_DIR}/parts
  RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of parts" status EQUAL 0)
file(READ ${WORK_DIR}/parts/results.csv results)
foreach(question yes-no yes-no-0.1% yes-no-1% all-pairs distance-0.1% distance-1% distance-10% distance-coherent)
  foreach(peer fcl pqp)
    expect("the answers of ${peer} to ${question}" results MATCHES "parts,${question} block,${peer},disagreements,0,1")
  endforeach()
endforeach()

execute_process(COMMAND ${BENCH} --only nonsense --out ${WORK_DIR} RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 2 for an unknown bench" status EQUAL 2)

file(COPY ${SOURCE_DIR}/docs/benchmarks.md DESTINATION ${WORK_DIR})
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${SOURCE_DIR}/scripts/bench_report.py
  ${WORK_DIR}/results.csv ${WORK_DIR}/benchmarks.md --command "smoke test" RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of the report" status EQUAL 0)
file(READ ${WORK_DIR}/benchmarks.md page)
expect("the new section" page MATCHES "<!-- begin zachmann -->\n[^\n]*smoke test.*<!-- end zachmann -->")
expect("the prose by hand" page MATCHES "## How it is measured")
expect("means of the scenes" page MATCHES "99th percentile")
foreach(plot figure3 scene)
  expect("the plot ${plot}" EXISTS ${WORK_DIR}/images/bench_${plot}.svg)
endforeach()

file(COPY ${SOURCE_DIR}/docs/benchmarks.md DESTINATION ${WORK_DIR}/hull)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${SOURCE_DIR}/scripts/bench_report.py
  ${WORK_DIR}/hull/results.csv ${WORK_DIR}/hull/benchmarks.md --command "smoke test" RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of the report on hulls" status EQUAL 0)
expect("the plot of hulls" EXISTS ${WORK_DIR}/hull/images/bench_hull.svg)

file(COPY ${SOURCE_DIR}/docs/benchmarks.md DESTINATION ${WORK_DIR}/parts)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${SOURCE_DIR}/scripts/bench_report.py
  ${WORK_DIR}/parts/results.csv ${WORK_DIR}/parts/benchmarks.md --command "smoke test" RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of the report on parts" status EQUAL 0)
file(READ ${WORK_DIR}/parts/benchmarks.md page)
expect("both peers of the parts" page MATCHES "FCL: geometric mean[^\n]*PQP's method: geometric mean")
expect("both ratios of the part" page MATCHES "[|] block [|] [0-9.]+ / [0-9.]+ [|]")
