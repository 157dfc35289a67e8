# cmake -D NODE=... -D NPM=... -D SOURCE=... -D PACKAGES=... -D OUTPUT=... -P build_page.cmake
#
# Installs the pinned packages into PACKAGES, unless they are there, and bundles SOURCE into OUTPUT.
function(leave_out what)
  file(REMOVE ${OUTPUT})
  message(NOTICE "The viewer (ballflow view) is left out: ${what}. The next build tries again.")
endfunction()

file(SHA256 ${SOURCE}/package-lock.json lock)
set(stamp ${PACKAGES}/installed.txt)
set(installed "")
if(EXISTS ${stamp})
  file(READ ${stamp} installed)
endif()
if(NOT installed STREQUAL lock)
  file(REMOVE ${stamp})
  file(COPY ${SOURCE}/package.json ${SOURCE}/package-lock.json ${SOURCE}/.npmrc DESTINATION ${PACKAGES})
  execute_process(COMMAND ${NPM} ci --ignore-scripts --prefer-offline --fetch-retries=1 --loglevel=error
    WORKING_DIRECTORY ${PACKAGES} RESULT_VARIABLE status ERROR_VARIABLE trouble OUTPUT_QUIET)
  if(NOT status EQUAL 0)
    string(STRIP "${trouble}" trouble)
    leave_out("npm could not install its packages\n${trouble}\n")
    return()
  endif()
  file(WRITE ${stamp} ${lock})
endif()
get_filename_component(folder ${OUTPUT} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${NODE} ${SOURCE}/bundle.mjs ${PACKAGES} ${OUTPUT} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  # The sources are wrong: that is an error of ours.
  message(FATAL_ERROR "The viewer could not be bundled")
endif()
