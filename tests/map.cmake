# Bakes and checks MAP with the command, exports it into the folder OUT and checks what came out.
file(MAKE_DIRECTORY "${OUT}")
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}: ended with ${result}")
  endif()
endfunction()

foreach(sight closed open)
  run("${COMMAND}" bake "${MAP}" -o "${OUT}/${sight}.slv" --check --sight ${sight} --stab-trees)
  run("${COMMAND}" export "${OUT}/${sight}.slv" --format json -o "${OUT}/${sight}.json")
  run("${PYTHON}" -B "${CMAKE_CURRENT_LIST_DIR}/check_export.py" --sightlines 50000
    "${OUT}/${sight}.json")
endforeach()
