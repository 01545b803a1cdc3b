# `cmake --install` puts the library, its headers and a package for find_package(pairsum) under the prefix.
include(CMakePackageConfigHelpers)

set(headers ${CMAKE_INSTALL_INCLUDEDIR}/pairsum)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/pairsum)
set_target_properties(pairsum_kernels PROPERTIES EXPORT_NAME pairsum OUTPUT_NAME pairsum)
set_target_properties(pairsum_options PROPERTIES EXPORT_NAME options)
install(TARGETS pairsum_kernels pairsum_options EXPORT pairsumTargets
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(PAIRSUM_FILES)
  set_target_properties(pairsum_files PROPERTIES EXPORT_NAME files)
  install(TARGETS pairsum_files EXPORT pairsumTargets)
endif()
if(TARGET pairsum_ranks)
  set(pairsum_ranks_built ON)
  set_target_properties(pairsum_ranks PROPERTIES EXPORT_NAME ranks)
  install(TARGETS pairsum_ranks EXPORT pairsumTargets)
endif()
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ ${CMAKE_CURRENT_BINARY_DIR}/generated/pairsum/ DESTINATION ${headers}
  FILES_MATCHING PATTERN "*.hpp" PATTERN cmake EXCLUDE)
install(EXPORT pairsumTargets NAMESPACE pairsum:: DESTINATION ${package})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/pairsumConfig.cmake.in pairsumConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(pairsumConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pairsumConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/pairsumConfigVersion.cmake
  DESTINATION ${package})
