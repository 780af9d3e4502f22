# cmake --install BUILD --prefix P: what a solid of one's own needs as a project of its own (docs/bring_your_own_solid.md).
#
#   P/include/amp_fsi             headers, as the sources include them: "common/program/participant.hpp"
#   P/lib                         libraries
#   P/lib/cmake/amp_fsi           find_package(amp_fsi), which gives the target amp_fsi::solid
#   P/libexec/amp_fsi             programs: FSI_BIN of the launcher
#   P/share/amp_fsi               the launcher, the cases, the messages; P/bin/fsi starts the launcher with these programs
#
# The first three are the component `sdk`, the others `programs` (--component).

include(CMakePackageConfigHelpers)

# All that a participant is linked with.
fsi_library(fsi_solid_sdk DEPENDS fsi_grid fsi_program_shell)
set_target_properties(fsi_solid_sdk PROPERTIES EXPORT_NAME solid)
target_compile_features(fsi_settings INTERFACE cxx_std_20)
target_include_directories(fsi_settings INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/amp_fsi>)
install(TARGETS fsi_solid_sdk fsi_settings fsi_core fsi_case fsi_grid fsi_exact fsi_interface fsi_io fsi_ranks fsi_bus fsi_idl
    fsi_picture fsi_program_shell
  EXPORT amp_fsi ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT sdk)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/amp_fsi)
install(EXPORT amp_fsi NAMESPACE amp_fsi:: FILE amp_fsiTargets.cmake DESTINATION ${package} COMPONENT sdk)
write_basic_package_version_file(amp_fsiConfigVersion.cmake COMPATIBILITY ExactVersion)
install(FILES cmake/amp_fsiConfig.cmake ${PROJECT_BINARY_DIR}/amp_fsiConfigVersion.cmake DESTINATION ${package}
  COMPONENT sdk)

set(headers ${CMAKE_INSTALL_INCLUDEDIR}/amp_fsi)
install(DIRECTORY common DESTINATION ${headers} COMPONENT sdk FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/common DESTINATION ${headers} COMPONENT sdk FILES_MATCHING PATTERN "*.hpp")

set(shared ${CMAKE_INSTALL_DATADIR}/amp_fsi)
install(DIRECTORY launch configs idl DESTINATION ${shared} COMPONENT programs USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE
  PATTERN CMakeLists.txt EXCLUDE)
install(FILES ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/build.json DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/amp_fsi COMPONENT programs)
file(CONFIGURE OUTPUT fsi @ONLY CONTENT [=[#!/bin/sh
# The launcher with the programs that were installed beside it.
here=$(dirname "$(readlink -f "$0")")
FSI_BIN=${FSI_BIN:-$here/../@CMAKE_INSTALL_LIBEXECDIR@/amp_fsi} FSI_CONFIGS=$here/../@shared@/configs \
  exec "$here/../@shared@/launch/fsi" "$@"
]=])
install(PROGRAMS ${PROJECT_BINARY_DIR}/fsi DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
