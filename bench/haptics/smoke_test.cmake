# Runs the benchmark of sliding contact on its smallest scenes and checks its output: results.csv has the promised columns
# and rows, no visible pose collides, and the figures appear on the page of benchmarks.
# Takes BENCH (the program), SOURCE_DIR (the repository) and WORK_DIR.

function(expect condition_name)
  if(NOT ${ARGN})
    message(FATAL_ERROR "Expected ${condition_name}. The program said:\n${said}\nresults.csv:\n${results}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
execute_process(COMMAND ${BENCH} --quick --parts scenes,sheets,pegs,solver,passivity,clasp --scenes plane,sheets --out ${WORK_DIR}
  RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0" status EQUAL 0)

file(STRINGS ${WORK_DIR}/results.csv results)
list(GET results 0 header)
expect("the header" header STREQUAL "bench,case,subject,metric,value,unit")
list(SUBLIST results 1 -1 rows)
foreach(row IN LISTS rows)
  expect("six columns, a number in the fifth: ${row}" row MATCHES "^(sliding|passivity|clasp),[^,]+,[^,]+,[^,]+,[-+.e0-9]+,[^,]+$")
endforeach()
foreach(case plane sheets)
  foreach(subject glissade glissade-paper)
    foreach(metric ticks final_stretch mean_stretch jammed_ticks force_jump queries_per_tick tick_p50 tick_p99)
      expect("${metric} of ${subject} in ${case}" results MATCHES "sliding,${case},${subject},${metric},[0-9.e+-]+,")
    endforeach()
    expect("no collision of ${subject} in ${case}" results MATCHES "sliding,${case},${subject},colliding_poses,0,1")
  endforeach()
  expect("no jam in ${case}" results MATCHES "sliding,${case},glissade,jammed_ticks,0,1")
endforeach()
expect("no sheet through another" results MATCHES "sliding,open-sheets,glissade,crossed,0,1")
foreach(case pegs-0.3mm-0.5deg pegs-1mm-1.5deg pegs-1mm-1.5deg-spiral-search)
  expect("pegs of ${case}" results MATCHES "sliding,${case},glissade,inserted,[0-9]+,1")
endforeach()
foreach(rows 1 64)
  expect("the cost of ${rows} rows" results MATCHES "sliding,solver-${rows},glissade,time_per_active,[0-9.e+-]+,us")
endforeach()

foreach(delay 0 1 5 20 50)
  expect("the stiffness with ${delay} ms" results MATCHES "passivity,sigma.7-${delay}ms,simulation,stiffness,[0-9.e+]+,N/m")
endforeach()
expect("no energy from nowhere" results MATCHES "passivity,random,glissade,least_energy,[0-9.e+-]+,J")

foreach(case free closing held wild from-scratch two-hands-100-objects)
  expect("the clasp of ${case}" results MATCHES "clasp,${case},glissade,call_p99,[0-9.e+-]+,ms")
endforeach()

# The scenes of this part have names of their own.
execute_process(COMMAND ${BENCH} --quick --parts ages --scenes car-door --out ${WORK_DIR}/ages
  RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of the ages" status EQUAL 0)
file(STRINGS ${WORK_DIR}/ages/results.csv results)
foreach(subject without-budget with-budget)
  foreach(metric age_p50 age_p99 age_max call_p50 call_p99 call_max lag_mean ended_early)
    expect("${metric} ${subject}" results MATCHES "ages,car-door,${subject},${metric},[0-9.e+-]+,")
  endforeach()
endforeach()

# A block with an oblique end, beside its copy and at its true size.
file(WRITE ${WORK_DIR}/led/block.obj "v 0 0 0\nv 3 0 0\nv 4 1 0\nv 0 1 0\nv 0 0 1\nv 3 0 1\nv 5 1 1\nv 0 1 1\n"
  "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
file(COPY_FILE ${WORK_DIR}/led/block.obj ${WORK_DIR}/led/other.obj)
file(WRITE ${WORK_DIR}/led/pairs.txt "block other 0.01 0 0 1.2\n")
execute_process(COMMAND ${BENCH} --quick --parts led --mesh ${WORK_DIR}/led --pairs ${WORK_DIR}/led/pairs.txt
  --out ${WORK_DIR}/led RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of the parts that are led" status EQUAL 0)
file(STRINGS ${WORK_DIR}/led/results.csv results)
foreach(case block other block/other)
  expect("no collision of ${case}" results MATCHES "led,${case},glissade,colliding_poses,0,1")
  expect("the time of ${case}" results MATCHES "led,${case},glissade,tick_p99,[0-9.e+-]+,ms")
endforeach()
file(WRITE ${WORK_DIR}/led/pairs.txt "block other 0.01\nblock other 0.01 0\n")
execute_process(COMMAND ${BENCH} --quick --parts led --mesh ${WORK_DIR}/led --pairs ${WORK_DIR}/led/pairs.txt
  --out ${WORK_DIR} RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 2 for a wrong line" status EQUAL 2)
expect("its number" said MATCHES "pairs.txt:2:")

file(COPY ${SOURCE_DIR}/docs/benchmarks.md DESTINATION ${WORK_DIR})
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${SOURCE_DIR}/scripts/bench_report.py
  ${WORK_DIR}/results.csv ${WORK_DIR}/benchmarks.md --command "smoke test" RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of the report" status EQUAL 0)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${SOURCE_DIR}/scripts/bench_report.py
  ${WORK_DIR}/ages/results.csv ${WORK_DIR}/benchmarks.md --command "smoke test" RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of the report of the ages" status EQUAL 0)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${SOURCE_DIR}/scripts/bench_report.py
  ${WORK_DIR}/led/results.csv ${WORK_DIR}/benchmarks.md --command "smoke test" RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0 of the report of the parts that are led" status EQUAL 0)
file(READ ${WORK_DIR}/benchmarks.md page)
expect("the new section" page MATCHES "<!-- begin sliding -->\n[^\n]*smoke test.*[|] plane [|].*<!-- end sliding -->")
expect("the stability" page MATCHES "[|] sigma.7 [|] 4000, .*<!-- end passivity -->")
expect("the ages" page MATCHES "<!-- begin ages -->\n[^\n]*smoke test.*[|] car-door, with budget [|].*<!-- end ages -->")
expect("the parts that are led" page MATCHES "[|] block/other [|] 24 [|].*<!-- end led -->")
expect("the clasp" page MATCHES "[|] from-scratch [|].*<!-- end clasp -->")
expect("the prose by hand" page MATCHES "## How it is measured")

execute_process(COMMAND ${BENCH} --scenes nowhere --parts scenes --out ${WORK_DIR} RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 2 for an unknown scene" status EQUAL 2)
expect("its name" said MATCHES "nowhere")
