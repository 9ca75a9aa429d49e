# cmake -D PROGRAM=pelvireg -D OUT=DIR -P quick_result.cmake: case quick with the runs that its baseline has. Stages that
# are up to date are skipped, so that a rerun repeats only what has changed.
set(stages "anatomy quick --out ${OUT}" "reference ${OUT} --jobs 1" "observe ${OUT}" "register ${OUT} --samples 8 --jobs 1"
           "evaluate ${OUT} --jobs 1" "report ${OUT} --jobs 1")
foreach(stage IN LISTS stages)
  separate_arguments(arguments UNIX_COMMAND "${stage}")
  execute_process(COMMAND ${PROGRAM} ${arguments} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
