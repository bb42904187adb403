# `cmake --workflow --preset package` makes Debian packages: `meninas`, the program with all it needs, `libmeninas0.2`,
# the shared library, `libmeninas-dev`, its header and the CMake package, and, where pybind11 is there, `python3-meninas`.
set(CPACK_PACKAGE_NAME meninas)
set(CPACK_PACKAGE_VENDOR Meninas)
set(CPACK_PACKAGE_CONTACT "Meninas maintainers <maintainers@meninas.example>" CACHE STRING "Who made the packages")
set(CPACK_GENERATOR DEB)
set(CPACK_SOURCE_GENERATOR "")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program runtime library)
if(TARGET _meninas)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
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

# The module that reads pictures is the program's.
set(soname ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(release ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libmeninas${soname})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/triggers)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "meninas (= ${release})")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "Shared library of Meninas, which renders rooms with mirrors by
radiosity and ray tracing, for programs that are built on it.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libmeninas-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libmeninas${soname} (= ${release})")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "Header of the shared library of Meninas, which renders rooms with mirrors by
radiosity and ray tracing, with the CMake package that finds it.")

# An extension module is of one version of Python.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-meninas)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
math(EXPR next_python "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "libmeninas${soname} (= ${release}), python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy, libc6, libstdc++6, libgcc-s1")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Python module of Meninas, which renders rooms with mirrors by radiosity and
ray tracing: pictures, solutions and form factors as NumPy arrays.")

if(MENINAS_DEBIAN_PACKAGES)
  find_program(MENINAS_GZIP gzip REQUIRED)
  execute_process(COMMAND ${MENINAS_GZIP} -9 --no-name --stdout ${PROJECT_SOURCE_DIR}/cmake/debian/changelog
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${MENINAS_GZIP} -9 --no-name --stdout ${PROJECT_SOURCE_DIR}/CHANGELOG.md
    OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)
  foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER ${component} component)
    string(TOLOWER ${component} name)
    install(FILES cmake/debian/copyright ${PROJECT_BINARY_DIR}/changelog.Debian.gz ${PROJECT_BINARY_DIR}/changelog.gz
      DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${component}_PACKAGE_NAME} COMPONENT ${name})
  endforeach()
endif()

include(CPack)
