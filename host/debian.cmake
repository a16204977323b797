# What Debian wants of a package beyond what is installed elsewhere: compressed manual pages, a changelog,
# and modules of Python where all of its versions look. CPack runs this before it makes the packages of
# what it has put below CPACK_TEMPORARY_INSTALL_DIRECTORY.
set(staged ${CPACK_TEMPORARY_INSTALL_DIRECTORY})
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, where it is set

foreach(component tool python)
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(share ${staged}/${component}/usr/share)
  if(NOT EXISTS ${share}/doc/${name})
    continue()
  endif()
  file(WRITE ${share}/doc/${name}/changelog
       "${name} (${CPACK_PACKAGE_VERSION}) stable; urgency=low\n\n"
       "  * CHANGELOG.md of the package gearsweep has what is new.\n\n"
       " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  file(GLOB pages ${share}/man/*/*)
  foreach(file ${share}/doc/${name}/changelog ${pages})
    execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endforeach()

file(GLOB modules ${staged}/python/usr/lib/python3.*/dist-packages)
if(modules)
  file(MAKE_DIRECTORY ${staged}/python/usr/lib/python3)
  file(RENAME ${modules} ${staged}/python/usr/lib/python3/dist-packages)
  get_filename_component(emptied ${modules} DIRECTORY)
  file(REMOVE_RECURSE ${emptied})
endif()
