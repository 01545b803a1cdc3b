# The readers and writers of particle files, a library of their own: a file per word of files/formats.def, and what they share.
find_package(PkgConfig REQUIRED)
pkg_check_modules(hdf5 QUIET IMPORTED_TARGET GLOBAL hdf5>=1.10)
if(NOT hdf5_FOUND)
  message(FATAL_ERROR "pairsum::files needs HDF5 1.10 or newer (Debian: libhdf5-dev); PAIRSUM_FILES=OFF builds without it")
endif()

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS files/formats.def)
file(STRINGS files/formats.def lines REGEX "^FORMAT\\(")
set(PAIRSUM_ALL_FORMATS "")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^FORMAT\\(([a-z0-9_]+)\\)$")
    message(FATAL_ERROR "kernels/files/formats.def: \"${line}\" is no word of the form FORMAT(name)")
  endif()
  if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/files/${CMAKE_MATCH_1}.cpp)
    message(FATAL_ERROR "kernels/files/formats.def names FORMAT(${CMAKE_MATCH_1}), but there is no kernels/files/${CMAKE_MATCH_1}.cpp")
  endif()
  list(APPEND PAIRSUM_ALL_FORMATS ${CMAKE_MATCH_1})
endforeach()
list(TRANSFORM PAIRSUM_ALL_FORMATS REPLACE "(.+)" "files/\\1.cpp" OUTPUT_VARIABLE formats)

add_library(pairsum_files STATIC files/bi4_items.cpp files/complete.cpp files/csv_header.cpp files/csv_lines.cpp files/domain.cpp
  files/formats.cpp files/hdf5_dialects.cpp files/hdf5_file.cpp files/hdf5_groups.cpp files/in_child.cpp files/kinds.cpp files/nearest_spacing.cpp files/read_particles.cpp
  files/support_radius.cpp files/words.cpp files/write_hdf.cpp files/write_xmf.cpp ${formats})
add_library(pairsum::files ALIAS pairsum_files)
target_link_libraries(pairsum_files PUBLIC pairsum_kernels PRIVATE PkgConfig::hdf5)
