# `cmake --workflow --preset package` makes two Debian packages: `meninas`, the program with all it needs, and
# `libmeninas-dev`, the libraries and headers with the -dev packages that their headers include.
set(CPACK_PACKAGE_NAME meninas)
set(CPACK_PACKAGE_VENDOR Meninas)
set(CPACK_PACKAGE_CONTACT "Meninas maintainers <maintainers@meninas.example>" CACHE STRING "Who made the packages")
set(CPACK_GENERATOR DEB)
set(CPACK_SOURCE_GENERATOR "")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_COMPONENTS_GROUPING IGNORE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME meninas)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "Meninas renders rooms from glTF files, with the light that mirrors throw:
radiosity extended with mirror worlds, then a ray tracer that follows what
mirrors and glass show. It also solves once for any number of views, runs
batches, writes a solved room as a web page to walk through or as lightmaps
in its own file, shows in a
browser how a room is solved, compares pictures, and computes form factors
and illuminance in lux.")

# What meninas-config.cmake looks for, as Debian packages.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libmeninas-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "meninas (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})" libembree-dev libopenexr-dev libpng-dev zlib1g-dev libglm-dev
  libtinygltf-dev libdraco-dev libmeshoptimizer-dev libtbb-dev libeigen3-dev libfmt-dev nlohmann-json3-dev
  libcpp-httplib-dev)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "Static libraries and headers of Meninas, which renders rooms with mirrors by
radiosity and ray tracing, with the CMake package that finds them.")

if(MENINAS_DEBIAN_PACKAGES)
  find_program(MENINAS_GZIP gzip REQUIRED)
  execute_process(COMMAND ${MENINAS_GZIP} -9 --no-name --stdout ${PROJECT_SOURCE_DIR}/cmake/debian/changelog
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${MENINAS_GZIP} -9 --no-name --stdout ${PROJECT_SOURCE_DIR}/CHANGELOG.md
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
  foreach(component IN ITEMS PROGRAM LIBRARY)
    string(TOLOWER ${component} name)
    install(FILES cmake/debian/copyright ${PROJECT_BINARY_DIR}/changelog.Debian.gz ${PROJECT_BINARY_DIR}/changelog.gz
      DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${component}_PACKAGE_NAME} COMPONENT ${name})
  endforeach()
endif()

include(CPack)
