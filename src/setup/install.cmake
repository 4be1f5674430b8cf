# What `cmake --install` puts where, and how others find it: the CMake package `vesica` (targets vesica::vesica, the
# static library with all it needs, and vesica::headers, enough for plugins) and the pkg-config file vesica.pc.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

add_library(vesica_headers INTERFACE)
set_target_properties(vesica_headers PROPERTIES EXPORT_NAME headers)
foreach(target vesica_core vesica_headers)
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endforeach()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/vesica)
configure_package_config_file(src/setup/vesicaConfig.cmake.in vesicaConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(vesicaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(src/setup/vesica.pc.in vesica.pc @ONLY)

install(TARGETS vesica_core vesica_headers EXPORT vesica)
if(TARGET vesica)
  install(TARGETS vesica)
endif()
install(EXPORT vesica NAMESPACE vesica:: FILE vesicaTargets.cmake DESTINATION ${package})
install(FILES ${CMAKE_BINARY_DIR}/vesicaConfig.cmake ${CMAKE_BINARY_DIR}/vesicaConfigVersion.cmake DESTINATION ${package})
install(FILES ${CMAKE_BINARY_DIR}/vesica.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(DIRECTORY include/vesica TYPE INCLUDE FILES_MATCHING PATTERN *.h)
install(DIRECTORY problems DESTINATION ${CMAKE_INSTALL_DATADIR}/vesica)
install(DIRECTORY docs/ TYPE DOC)
install(FILES LICENSE TYPE DOC)
