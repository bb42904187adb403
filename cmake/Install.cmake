# What `cmake --install` lays down: the program with its manual pages, completions, documents and schemas (component
# `program`), the shared library (`runtime`), and its header with the package that finds it (`library`).
# Everything is found relative to itself, so the installed tree can be moved.
include(CMakePackageConfigHelpers)

# After `./meninas` alone there is the program and nothing else: the rest is built when it is laid down.
set(laid_down meninas_cli meninas_library meninas_manuals meninas_jobs_schema)
if(TARGET _meninas)
  list(APPEND laid_down _meninas)
endif()
list(JOIN laid_down " " laid_down)
install(CODE "execute_process(
  COMMAND \"${CMAKE_COMMAND}\" --build \"${CMAKE_BINARY_DIR}\" --target ${laid_down}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)" ALL_COMPONENTS)

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
install(DIRECTORY integrations/openjd integrations/kubernetes DESTINATION ${CMAKE_INSTALL_DATADIR}/meninas COMPONENT program
  FILES_MATCHING PATTERN "*.yaml")

# In the places they have here, so that their links lead somewhere.
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
if(NOT MENINAS_DEBIAN_PACKAGES) # cmake/Package.cmake has Debian's names for them
  install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
endif()
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
  PATTERN "*.sh" EXCLUDE PATTERN "notes" EXCLUDE)
install(DIRECTORY scenes/gallery DESTINATION ${CMAKE_INSTALL_DOCDIR}/scenes COMPONENT program
  FILES_MATCHING PATTERN "*.gltf" PATTERN "*.glb" PATTERN "README.md" PATTERN "generator" EXCLUDE PATTERN "living_room" EXCLUDE PATTERN "blender" EXCLUDE)

# The library is what its one header says: nothing of what it is built from is installed.
install(FILES library/meninas.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/meninas COMPONENT library)
install(TARGETS meninas_library EXPORT meninas-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime NAMELINK_COMPONENT library)

install(EXPORT meninas-targets NAMESPACE meninas:: DESTINATION ${package_directory} COMPONENT library)
configure_package_config_file(cmake/meninas-config.cmake.in meninas-config.cmake
  INSTALL_DESTINATION ${package_directory} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(meninas-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/meninas-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/meninas-config-version.cmake
  DESTINATION ${package_directory} COMPONENT library)
