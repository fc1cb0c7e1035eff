# What `cmake --install` writes, and the Debian package that `cpack` makes of it (preset "package").
install(TARGETS ventricle RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# Made by the program itself, of the declarations that its --help prints.
install(CODE "
  foreach(document man completion)
    execute_process(COMMAND $<TARGET_FILE:ventricle> \${document} COMMAND_ERROR_IS_FATAL ANY
                    OUTPUT_FILE ${CMAKE_BINARY_DIR}/ventricle.\${document})
  endforeach()")
install(FILES ${CMAKE_BINARY_DIR}/ventricle.man DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME ventricle.1)
install(FILES ${CMAKE_BINARY_DIR}/ventricle.completion DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ventricle)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "The ventricle authors <ventricle@example.org>")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# what no library names: mpirun, and the letters of the figures
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin, fonts-dejavu-core")
include(CPack)
