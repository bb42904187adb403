# Every package the project uses, from Debian 12 by the ordinary find_package.
# A library that the installed static libraries link must be named in meninas-config.cmake.in too.
option(MENINAS_BUILD_TESTS "Build the tests and benchmarks" ${PROJECT_IS_TOP_LEVEL})

find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(embree 3 REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(draco REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)

# Debian's OpenImageIO target lists an include directory that its package does not install.
get_target_property(oiio_includes OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
set(existing_includes "")
foreach(directory IN LISTS oiio_includes)
  if(EXISTS "${directory}")
    list(APPEND existing_includes "${directory}")
  endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${existing_includes}")

if(MENINAS_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(benchmark REQUIRED)
  include(GoogleTest)
endif()
