# find_package(amp_fsi): the target amp_fsi::solid, for a solid of one's own (docs/bring_your_own_solid.md). The packages that it
# needs are those that AMP-FSI itself was built with.

include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(Eigen3 3.4)
find_dependency(fmt)
find_dependency(spdlog)
find_dependency(muparser)
find_dependency(yaml-cpp)
find_dependency(nlohmann_json)
find_dependency(OpenSSL COMPONENTS Crypto)
find_dependency(ZLIB)
find_dependency(CycloneDDS)
include(${CMAKE_CURRENT_LIST_DIR}/amp_fsiTargets.cmake)
