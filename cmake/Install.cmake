# What `cmake --install` lays down: the program, the libraries with their headers, and the package that finds them.
# Everything is found relative to itself, so the installed tree can be moved.
include(CMakePackageConfigHelpers)

set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/meninas)

install(TARGETS meninas_cli RUNTIME)
foreach(folder IN ITEMS scenes image mirror form_factors radiosity raytrace reference runs)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/meninas
    FILES_MATCHING PATTERN "*.h" PATTERN "gallery" EXCLUDE)
endforeach()
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES docs/regress.schema.json ${CMAKE_BINARY_DIR}/batch.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/meninas)

# A stranger's program finds the image module by the search path it gets with the library that opens it.
target_link_options(meninas_image INTERFACE
  $<INSTALL_INTERFACE:-Wl,-rpath,$<INSTALL_PREFIX>/${CMAKE_INSTALL_LIBDIR}/meninas>)

install(EXPORT meninas-targets NAMESPACE meninas:: DESTINATION ${package_directory})
configure_package_config_file(cmake/meninas-config.cmake.in meninas-config.cmake
  INSTALL_DESTINATION ${package_directory} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(meninas-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/meninas-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/meninas-config-version.cmake
  DESTINATION ${package_directory})
