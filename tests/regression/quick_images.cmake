# cmake -D PROGRAM=… -D FROM=… -D OUT=… -P quick_images.cmake: images of a copy of case quick's result, tracked.
function(run expected)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE error RESULT_VARIABLE status)
  if(NOT status EQUAL 0 OR NOT output MATCHES "${expected}")
    message(FATAL_ERROR "pelvireg ${ARGN}: status ${status}, '${expected}' expected\n${output}\n${error}")
  endif()
endfunction()

file(REMOVE_RECURSE ${OUT})
file(COPY ${FROM}/ DESTINATION ${OUT})
set(options --matrix 128 --pixel 2.5 --segments 1)
run("images: done" images ${OUT} ${options} --jobs 2)
run("images: up to date" images ${OUT} ${options} --jobs 2)
file(SHA256 ${OUT}/images/dyn.nrrd first)
file(GLOB frames ${OUT}/images/dyn/*.dcm)
list(LENGTH frames n_frames)
if(NOT n_frames EQUAL 25) # 8 increments
  message(FATAL_ERROR "${n_frames} DICOM files, 25 expected")
endif()
run("bezier +bladder" track ${OUT})

# Other noise, other images; the same noise again, the same bytes.
run("images: done" images ${OUT} ${options} --snr 10 --jobs 2)
file(SHA256 ${OUT}/images/dyn.nrrd noisier)
run("images: done" images ${OUT} ${options} --jobs 1)
file(SHA256 ${OUT}/images/dyn.nrrd again)
if(noisier STREQUAL first OR NOT again STREQUAL first)
  message(FATAL_ERROR "SNR 20 twice: ${first}, ${again}; SNR 10: ${noisier}")
endif()
