# Untried. Copy this folder to ports/sightline, and set SOURCE_PATH to a checkout or a release archive.
set(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../..")
vcpkg_check_features(OUT_FEATURE_OPTIONS features FEATURES analysis SIGHTLINE_ANALYSIS
  io SIGHTLINE_IO draw SIGHTLINE_DRAW)
vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS ${features} -DSIGHTLINE_STUDY=OFF -DSIGHTLINE_GLPK=OFF -DSIGHTLINE_TOOLS=OFF -DSIGHTLINE_VIEWER=OFF
    -DSIGHTLINE_PYTHON=OFF -DSIGHTLINE_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/sightline)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
