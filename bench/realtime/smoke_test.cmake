# Runs the bench of handoffs and a short `glissade latency`, and checks the rows of both and their sections on the page of
# benchmarks. Takes BENCH and GLISSADE (the programs), SOURCE_DIR (the repository) and WORK_DIR.

function(expect condition_name)
  if(NOT ${ARGN})
    message(FATAL_ERROR "Expected ${condition_name}. The program said:\n${said}\nresults.csv:\n${results}")
  endif()
endfunction()

function(report results_file)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1 ${SOURCE_DIR}/scripts/bench_report.py
    ${results_file} ${WORK_DIR}/benchmarks.md --command "smoke test" RESULT_VARIABLE status ERROR_VARIABLE said)
  expect("exit code 0 of the report" status EQUAL 0)
  file(READ ${WORK_DIR}/benchmarks.md page)
  set(page "${page}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
file(COPY ${SOURCE_DIR}/docs/benchmarks.md DESTINATION ${WORK_DIR})

execute_process(COMMAND ${BENCH} --quick --out ${WORK_DIR} RESULT_VARIABLE status ERROR_VARIABLE said)
expect("exit code 0" status EQUAL 0)
file(STRINGS ${WORK_DIR}/results.csv results)
foreach(value glove-state haptic-state contact-set)
  foreach(subject glissade glissade-ring mutex boost-spsc)
    expect("a call of ${subject}" results MATCHES "handoff,${value}-one-thread,${subject},time,[0-9.e+]+,ns")
    foreach(metric time time_p99 publish_p50 publish_p99)
      expect("${metric} of ${subject}" results MATCHES "handoff,${value}-two-threads,${subject},${metric},[0-9.e+]+,ns")
    endforeach()
  endforeach()
endforeach()
foreach(peer mutex boost-spsc)
  expect("a ratio to ${peer}" results MATCHES "handoff,geomean,glissade,ratio_to_${peer},[0-9.e+]+,x")
endforeach()
report(${WORK_DIR}/results.csv)
expect("the handoffs" page MATCHES "<!-- begin handoff -->\n[^\n]*smoke test.*[|] glove-state, [0-9]+ B, ring [|].*<!-- end handoff -->")

# Its multicast stays in a network of its own.
execute_process(COMMAND ${SOURCE_DIR}/scripts/in_network_namespace ${GLISSADE} latency --seconds 0.6 --json
  RESULT_VARIABLE status OUTPUT_FILE ${WORK_DIR}/latency.json ERROR_VARIABLE said)
if(status EQUAL 77)
  message(STATUS "latency is skipped: ${said}")
  return()
endif()
expect("exit code 0 of latency" status EQUAL 0)
execute_process(COMMAND ${SOURCE_DIR}/scripts/bench_latency.py ${WORK_DIR}/latency.json
  RESULT_VARIABLE status OUTPUT_FILE ${WORK_DIR}/latency.csv ERROR_VARIABLE said)
expect("exit code 0 of bench_latency.py" status EQUAL 0)
file(STRINGS ${WORK_DIR}/latency.csv results)
foreach(case in-process-idle memq-idle udpm-idle udpm-loaded)
  foreach(stage transport wait computation way_back whole haptic_lateness bare_lateness)
    expect("${stage} of ${case}" results MATCHES "latency,${case},glissade,${stage}_p99,[0-9.e+]+,us")
  endforeach()
endforeach()
report(${WORK_DIR}/latency.csv)
expect("the latencies" page MATCHES "<!-- begin latency -->\n[^\n]*smoke test.*[|] sample to force [|].*<!-- end latency -->")
