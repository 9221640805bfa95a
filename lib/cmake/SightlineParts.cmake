# The parts beside the core library: an option SIGHTLINE_NAME for each. At top level a part is ON by
# default where its packages are found. In another project everything but the core is OFF by
# default, and no package is looked for.
include_guard()
include(CheckCSourceCompiles)
find_package(PkgConfig QUIET)

# sightline_part(NAME WHAT [PACKAGE]...)
#
# A package is PREFIX=MODULE, found by pkg-config as the target PkgConfig::PREFIX, or PREFIX, found by
# find_package as the target PREFIX::PREFIX, or the name of another part.
function(sightline_part name what)
  set(missing "")
  if(SIGHTLINE_TOP_LEVEL OR SIGHTLINE_${name})
    foreach(package IN LISTS ARGN)
      if(DEFINED sightline_is_part_${package})
        if(NOT SIGHTLINE_${package})
          list(APPEND missing SIGHTLINE_${package}=ON)
        endif()
      elseif(package MATCHES "^(.+)=(.+)$")
        set(prefix ${CMAKE_MATCH_1})
        set(module ${CMAKE_MATCH_2})
        if(PKG_CONFIG_FOUND AND NOT TARGET PkgConfig::${prefix})
          pkg_check_modules(${prefix} QUIET IMPORTED_TARGET GLOBAL ${module})
        endif()
        if(NOT TARGET PkgConfig::${prefix})
          list(APPEND missing ${module})
        elseif(CMAKE_CROSSCOMPILING) # pkg-config may have found that of this machine
          set(CMAKE_REQUIRED_LIBRARIES PkgConfig::${prefix})
          set(CMAKE_REQUIRED_QUIET ON)
          check_c_source_compiles("int main(void) { return 0; }" SIGHTLINE_LINKS_${prefix})
          if(NOT SIGHTLINE_LINKS_${prefix})
            list(APPEND missing "${module} for ${CMAKE_SYSTEM_NAME} (what pkg-config finds does not link)")
          endif()
        endif()
      else()
        find_package(${package} QUIET)
        if(NOT TARGET ${package}::${package})
          list(APPEND missing ${package})
        endif()
      endif()
    endforeach()
  endif()
  list(JOIN missing ", " missing)

  if(DEFINED SIGHTLINE_${name} OR NOT missing)
    option(SIGHTLINE_${name} "${what}" ${SIGHTLINE_TOP_LEVEL})
  else() # not kept: the packages may be there at the next run
    set(SIGHTLINE_${name} OFF)
  endif()
  if(SIGHTLINE_${name} AND missing)
    message(FATAL_ERROR "SIGHTLINE_${name} needs ${missing}: not found. On most systems "
      "'sh tools/setup.sh' installs it; or configure with -DSIGHTLINE_${name}=OFF.")
  elseif(missing)
    message(STATUS "SIGHTLINE_${name} is OFF (${what}): not found: ${missing}")
  elseif(SIGHTLINE_TOP_LEVEL AND NOT SIGHTLINE_${name})
    message(STATUS "SIGHTLINE_${name} is OFF (${what}): as asked for")
  endif()
  set(SIGHTLINE_${name} ${SIGHTLINE_${name}} PARENT_SCOPE)
  set(sightline_is_part_${name} TRUE PARENT_SCOPE)
endfunction()

sightline_part(ANALYSIS "sightline_analysis: visibility graphs, axial lines, segments")
sightline_part(IO "sightline_io: maps and exports of other programs"
  LIBXML2=libxml-2.0 JANSSON=jansson PNG=libpng YAML=yaml-0.1 ZSTD=libzstd ZLIB)
sightline_part(PYTHON "the Python package sightline" ANALYSIS IO)
sightline_part(LEVEL "sightline_level: the runtime behind a handle, for other languages")
sightline_part(STUDY "sightline_study: what exists to compare and to teach")
sightline_part(GLPK "sightline_glpk: stabbing by GLPK, which is under the GPL" GLPK)
sightline_part(DRAW "sightline_draw: pictures through cairo and Pango"
  CAIRO=cairo PANGOCAIRO=pangocairo)
sightline_part(TOOLS "the sightline command" ANALYSIS)
sightline_part(VIEWER "the viewer" SDL2=sdl2 ANALYSIS IO STUDY DRAW)
sightline_part(TESTS "the tests" CMOCKA=cmocka PNG=libpng ZLIB ANALYSIS IO STUDY)
