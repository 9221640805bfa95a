# What `cmake --install` puts down: libraries, headers, the command, the CMake package `sightline`
# (components analysis, io, study, glpk, draw, runtime and level) and pkg-config files. All of it can be
# moved as one. `--component` takes a part, for packages: tools/packages/README.md lists them.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/sightline")
set(pkgconfig_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
set(in "${PROJECT_SOURCE_DIR}/lib/cmake")
set(out "${PROJECT_BINARY_DIR}/package")

# A directory of the installation as a pkg-config file says it.
function(from_prefix out_name dir)
  if(IS_ABSOLUTE "${dir}")
    set(${out_name} "${dir}" PARENT_SCOPE)
  else()
    set(${out_name} "\${prefix}/${dir}" PARENT_SCOPE)
  endif()
endfunction()
from_prefix(PC_LIBDIR "${CMAKE_INSTALL_LIBDIR}")
from_prefix(PC_INCLUDEDIR "${CMAKE_INSTALL_INCLUDEDIR}")
if(IS_ABSOLUTE "${pkgconfig_dir}")
  set(PC_PREFIX "${CMAKE_INSTALL_PREFIX}")
else()
  file(RELATIVE_PATH up "/${pkgconfig_dir}" "/")
  string(REGEX REPLACE "/$" "" up "${up}")
  set(PC_PREFIX "\${pcfiledir}/${up}")
endif()
set(PC_CFLAGS "-I\${includedir}")
if(BUILD_SHARED_LIBS)
  string(APPEND PC_CFLAGS " -DSIGHTLINE_SHARED")
endif()

function(install_library target)
  set(component libraries)
  if(target STREQUAL "sightline_glpk") # under another licence
    set(component glpk)
  endif()
  install(TARGETS ${target} EXPORT ${target}-targets
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${component}
      NAMELINK_COMPONENT development
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT ${component})
  install(EXPORT ${target}-targets NAMESPACE sightline:: DESTINATION "${package_dir}")
  configure_file("${in}/${target}.pc.in" "${out}/${target}.pc" @ONLY)
  install(FILES "${out}/${target}.pc" DESTINATION "${pkgconfig_dir}")
endfunction()

# The headers of a part come with it; all others belong to the core.
set(headers "${PROJECT_SOURCE_DIR}/lib/include/sightline")
set(analysis_headers
  art_gallery.h axial.h coverage.h exposure.h path.h path_parts.h place.h place_area.h place_proof.h
  reach.h rooms.h set_cover.h set_sight.h vga.h viewpoint.h)
set(io_headers io.h)
set(study_headers from_region.h generate.h view_cells.h walk.h)
set(glpk_headers glpk.h)
set(draw_headers draw.h)
set(not_core "")
foreach(header IN LISTS analysis_headers io_headers study_headers glpk_headers draw_headers)
  list(APPEND not_core PATTERN ${header} EXCLUDE)
endforeach()
install_library(sightline)
install(DIRECTORY "${headers}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
  FILES_MATCHING PATTERN "*.h" ${not_core})

install_library(sightline_runtime)
install(FILES "${PROJECT_SOURCE_DIR}/lib/runtime/sightline_runtime.h"
  DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")

if(SIGHTLINE_LEVEL)
  install_library(sightline_level)
  install(FILES "${PROJECT_SOURCE_DIR}/lib/bindings/level/sightline_level.h"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
endif()
if(SIGHTLINE_GLPK)
  get_filename_component(dir "${GLPK_LIBRARY}" DIRECTORY)
  set(PC_GLPK_LIBS "-lglpk")
  if(NOT dir IN_LIST CMAKE_C_IMPLICIT_LINK_DIRECTORIES)
    set(PC_GLPK_LIBS "-L${dir} -lglpk")
  endif()
  install(FILES "${in}/FindGLPK.cmake" DESTINATION "${package_dir}")
endif()
foreach(part analysis io study glpk draw)
  string(TOUPPER ${part} option)
  if(SIGHTLINE_${option})
    install_library(sightline_${part})
    list(TRANSFORM ${part}_headers PREPEND "${headers}/")
    install(FILES ${${part}_headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/sightline")
  endif()
endforeach()

configure_package_config_file("${in}/sightline-config.cmake.in" "${out}/sightline-config.cmake"
  INSTALL_DESTINATION "${package_dir}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${out}/sightline-config-version.cmake"
  COMPATIBILITY SameMajorVersion)
install(FILES "${out}/sightline-config.cmake" "${out}/sightline-config-version.cmake"
  DESTINATION "${package_dir}")

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME tools)
if(SIGHTLINE_TOOLS)
  install(TARGETS sightline_command RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  if(TARGET sightline_mpi)
    install(TARGETS sightline_mpi RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  endif()
  if(TARGET sightline_manual)
    install(DIRECTORY "${PROJECT_BINARY_DIR}/tools/manual/"
      DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" FILES_MATCHING PATTERN "*.1")
  endif()
  set(completion "${PROJECT_SOURCE_DIR}/tools/completion")
  install(FILES "${completion}/sightline.bash" RENAME sightline
    DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  install(FILES "${completion}/_sightline" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
  install(FILES "${completion}/sightline.fish"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
endif()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME licences)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
if(SIGHTLINE_GLPK)
  install(FILES "${in}/NOTICE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
endif()

# `cpack --config build/release/CPackConfig.cmake`: an archive that can be unpacked anywhere.
set(CPACK_GENERATOR TGZ)
set(CPACK_PACKAGE_VENDOR "Sightline contributors")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_STRIP_FILES TRUE)
include(CPack)
