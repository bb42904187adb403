# What `cmake --install` lays down: the program with its manual pages, completions, documents and schemas (component
# `program`), and the libraries with their headers and the package that finds them (component `library`).
# Everything is found relative to itself, so the installed tree can be moved.
include(CMakePackageConfigHelpers)

set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/meninas)
option(MENINAS_DEBIAN_PACKAGES "Lay down what Debian packages contain, where Debian has it" OFF)
set(zsh_folder site-functions)
if(MENINAS_DEBIAN_PACKAGES)
  set(zsh_folder vendor-completions)
endif()

install(TARGETS meninas_cli RUNTIME COMPONENT program)
set(manuals ${CMAKE_BINARY_DIR}/manuals)
install(DIRECTORY ${manuals}/man/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
install(FILES ${manuals}/bash/meninas DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${manuals}/zsh/_meninas DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${zsh_folder} COMPONENT program)
install(FILES ${manuals}/fish/meninas.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
install(FILES docs/regress.schema.json ${CMAKE_BINARY_DIR}/batch.schema.json
  DESTINATION ${CMAKE_INSTALL_DATADIR}/meninas COMPONENT program)

install(PROGRAMS integrations/slurm/meninas-slurm DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY integrations/openjd DESTINATION ${CMAKE_INSTALL_DATADIR}/meninas COMPONENT program
  FILES_MATCHING PATTERN "*.yaml")

# In the places they have here, so that their links lead somewhere.
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
if(NOT MENINAS_DEBIAN_PACKAGES) # cmake/Package.cmake has Debian's names for them
  install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
endif()
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
  PATTERN "*.sh" EXCLUDE PATTERN "notes" EXCLUDE)
install(DIRECTORY scenes/gallery DESTINATION ${CMAKE_INSTALL_DOCDIR}/scenes COMPONENT program
  FILES_MATCHING PATTERN "*.gltf" PATTERN "*.glb" PATTERN "README.md" PATTERN "generator" EXCLUDE PATTERN "blender" EXCLUDE)

foreach(folder IN ITEMS scenes image mirror form_factors radiosity raytrace reference runs)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/meninas COMPONENT library
    FILES_MATCHING PATTERN "*.h" PATTERN "gallery" EXCLUDE)
endforeach()

# A stranger's program finds the image module by the search path it gets with the library that opens it.
target_link_options(meninas_image INTERFACE
  $<INSTALL_INTERFACE:-Wl,-rpath,$<INSTALL_PREFIX>/${CMAKE_INSTALL_LIBDIR}/meninas>)

install(EXPORT meninas-targets NAMESPACE meninas:: DESTINATION ${package_directory} COMPONENT library)
configure_package_config_file(cmake/meninas-config.cmake.in meninas-config.cmake
  INSTALL_DESTINATION ${package_directory} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(meninas-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/meninas-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/meninas-config-version.cmake
  DESTINATION ${package_directory} COMPONENT library)
