# What `cmake --install` and the Debian packages hold. Component "runtime" plays shows; "development" has the
# libraries for programs that embed Stadion, with the targets Stadion::engine, dynamics, pipeline, profiling, show and
# measure, and Stadion::plugin for plugins.
include(CMakePackageConfigHelpers)

install(TARGETS stadion RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
install(TARGETS stadion-import stadion-wall RUNTIME DESTINATION lib/stadion COMPONENT runtime)
install(TARGETS stadion-http LIBRARY DESTINATION lib/stadion COMPONENT runtime)
# Where they have been built.
install(TARGETS stadion-measure stadion-bench stadion-dyn-stadion RUNTIME DESTINATION lib/stadion COMPONENT runtime
  OPTIONAL)
install(DIRECTORY scripts walls DESTINATION ${CMAKE_INSTALL_DATADIR}/stadion COMPONENT runtime)
install(DIRECTORY assets DESTINATION ${CMAKE_INSTALL_DATADIR}/stadion COMPONENT runtime PATTERN generator EXCLUDE)
# Pages keep their places, so that the links between them lead somewhere. The folder has the package's name.
set(pages_folder ${CMAKE_INSTALL_DATADIR}/doc/stadion)
install(DIRECTORY docs DESTINATION ${pages_folder} COMPONENT runtime)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md packaging/copyright DESTINATION ${pages_folder}
  COMPONENT runtime)
file(GLOB_RECURSE pages RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS assets/README.md bench/*.md cli/*.md
  dynamics/*.md engine/*.md examples/*.md pipeline/*.md profiling/*.md scripts/*.md show/*.md tests/*.md walls/*.md)
foreach(page IN LISTS pages)
  get_filename_component(folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION ${pages_folder}/${folder} COMPONENT runtime)
endforeach()

# The programs write their man pages when they are installed.
install(CODE "
  file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1\")
  foreach(program stadion stadion-measure stadion-bench)
    if(EXISTS \"$<TARGET_FILE_DIR:stadion>/\${program}\")
      execute_process(COMMAND \"$<TARGET_FILE_DIR:stadion>/\${program}\" manual man COMMAND_ERROR_IS_FATAL ANY
        OUTPUT_FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1/\${program}.1\")
    endif()
  endforeach()" COMPONENT runtime)
set(completion ${PROJECT_SOURCE_DIR}/packaging/completion)
install(FILES ${completion}/stadion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME stadion
  COMPONENT runtime)
install(FILES ${completion}/_stadion DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT runtime)
install(FILES ${completion}/stadion.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
  COMPONENT runtime)

# What a machine in a hall needs: services for systemd, with the place of the programs, and a user that plays shows.
install(PROGRAMS packaging/hall/stadion-display DESTINATION lib/stadion COMPONENT runtime)
install(FILES packaging/hall/stadion.sysusers DESTINATION lib/sysusers.d RENAME stadion.conf COMPONENT runtime)
install(CODE "
  foreach(unit stadion@.service stadion-display.service)
    file(READ \"${PROJECT_SOURCE_DIR}/packaging/hall/\${unit}\" text)
    string(REPLACE \"@PREFIX@\" \"\${CMAKE_INSTALL_PREFIX}\" text \"\${text}\")
    file(WRITE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib/systemd/system/\${unit}\" \"\${text}\")
  endforeach()" COMPONENT runtime)

install(TARGETS stadion_options stadion_sanitize stadion_plugin stadion_engine stadion_wire stadion_pipeline
  stadion_dynamics stadion_profiling stadion_show stadion_measure EXPORT StadionTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
foreach(layer engine pipeline dynamics profiling show)
  set_target_properties(stadion_${layer} PROPERTIES EXPORT_NAME ${layer})
  add_library(Stadion::${layer} ALIAS stadion_${layer})
  install(DIRECTORY ${layer} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stadion COMPONENT development
    FILES_MATCHING PATTERN "*.h" PATTERN "*_program" EXCLUDE)
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/wire.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stadion COMPONENT development)

foreach(target plugin measure)
  set_target_properties(stadion_${target} PROPERTIES EXPORT_NAME ${target})
  add_library(Stadion::${target} ALIAS stadion_${target})
endforeach()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Stadion)
install(EXPORT StadionTargets NAMESPACE Stadion:: DESTINATION ${package} COMPONENT development)
configure_package_config_file(packaging/StadionConfig.cmake.in ${PROJECT_BINARY_DIR}/StadionConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/StadionConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/StadionConfig.cmake ${PROJECT_BINARY_DIR}/StadionConfigVersion.cmake
  DESTINATION ${package} COMPONENT development)

if(PROJECT_IS_TOP_LEVEL)
  # What is installed has been built before: packages need no tests.
  set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_CONTACT "the Stadion project")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Show engine for immersive virtual reality on several walls")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_COMPONENTS_ALL runtime development)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME stadion)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
  # Loaded at run time: no program names them.
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS "libosmesa6, libddsc0debian, libsndfile1, libzip4")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS
    "libegl1, libegl-mesa0, libgl1-mesa-dri, libglfw3, libopenal1, libasound2, libxss1, ffmpeg")
  # For stadion-display.service, and for its user.
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "xserver-xorg-core, xserver-xorg-input-libinput, xauth, systemd")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA
    "${PROJECT_SOURCE_DIR}/packaging/hall/postinst;${PROJECT_SOURCE_DIR}/packaging/hall/postrm")
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libstadion-dev)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
  set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS runtime)
  set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
  string(CONCAT CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "g++, cmake, pkg-config, libeigen3-dev, libfcl-dev, libfmt-dev, "
    "libxxhash-dev, libpng-dev, libpugixml-dev, libmeshoptimizer-dev, libhwloc-dev, liblo-dev, "
    "libmd-dev, nlohmann-json3-dev, "
    "cyclonedds-dev, libgl-dev")
  include(CPack)
endif()
