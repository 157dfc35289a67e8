# What Debian asks of a package beyond what `cmake --install` makes. CPack runs it on the folder that is to be packed.
set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share)
set(doc ${share}/doc/ballflow)
file(MAKE_DIRECTORY ${doc})

function(compress)
  execute_process(COMMAND gzip -9 --no-name --force ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(GLOB pages ${share}/man/man1/*.1)
compress(${pages})

# Debian's zsh does not look into the site's functions of a package.
file(MAKE_DIRECTORY ${share}/zsh/vendor-completions)
file(RENAME ${share}/zsh/site-functions/_ballflow ${share}/zsh/vendor-completions/_ballflow)
file(REMOVE_RECURSE ${share}/zsh/site-functions)

# The module for Debian's own Python; it finds node libraries and graphs from there.
if(CPACK_BALLFLOW_PYTHON)
  set(module ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/lib/python3/dist-packages/ballflow)
  file(GLOB files ${CPACK_BALLFLOW_PYTHON}/*.py ${CPACK_BALLFLOW_PYTHON}/*.pyi ${CPACK_BALLFLOW_PYTHON}/py.typed
    ${CPACK_BALLFLOW_PYTHON}/_core*.so)
  file(COPY ${files} DESTINATION ${module} FOLLOW_SYMLINK_CHAIN
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(GLOB extension ${module}/_core*.so)
  execute_process(COMMAND strip --strip-unneeded ${extension} COMMAND_ERROR_IS_FATAL ANY)
endif()

configure_file(${CPACK_BALLFLOW_SOURCE}/cmake/debian/copyright ${doc}/copyright COPYONLY)
configure_file(${CPACK_BALLFLOW_SOURCE}/CHANGELOG.md ${doc}/changelog COPYONLY)
# The day of packaging; $SOURCE_DATE_EPOCH sets another one.
string(TIMESTAMP day "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${doc}/changelog.Debian
  "ballflow (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
  "  * What changed is in changelog.gz.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${day}\n")
compress(${doc}/changelog ${doc}/changelog.Debian)
