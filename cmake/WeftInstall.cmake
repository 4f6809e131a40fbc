# cmake --install and cpack: the program, its assets, what a desktop wants, and the libraries for find_package(weft).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS weft RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/assets/demo DESTINATION ${CMAKE_INSTALL_DATADIR}/weft/assets
        COMPONENT program)
set(linux ${PROJECT_SOURCE_DIR}/packaging/linux)
install(FILES ${linux}/io.weft.Weft.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT program)
install(FILES ${linux}/io.weft.Weft.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps
        COMPONENT program)
install(FILES ${linux}/weft-mime.xml RENAME weft.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages
        COMPONENT program)
install(FILES ${PROJECT_BINARY_DIR}/packaging/io.weft.Weft.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo COMPONENT program)
# In Debian's place whatever the folder of the documents is called.
install(FILES ${PROJECT_BINARY_DIR}/packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/weft COMPONENT program)
install(FILES ${linux}/weft.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${linux}/weft.bash RENAME weft DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/packaging/python/weft
        DESTINATION lib/python3/dist-packages COMPONENT program
        FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN __pycache__ EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/packaging/blender/ DESTINATION ${CMAKE_INSTALL_DATADIR}/weft/blender
        COMPONENT program PATTERN __pycache__ EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
        FILES_MATCHING PATTERN "*.md" PATTERN "*.json" PATTERN decisions EXCLUDE PATTERN images EXCLUDE)

# The libraries: everything below the command line. weft::weft stands for all of them.
add_library(weft_api INTERFACE)
target_link_libraries(weft_api INTERFACE weft::exchange weft::measure)
target_compile_features(weft_api INTERFACE cxx_std_20)
set_target_properties(weft_api PROPERTIES EXPORT_NAME weft)
get_property(libraries GLOBAL PROPERTY WEFT_LIBRARIES)
list(REMOVE_ITEM libraries weft_mattes weft_textures weft_preview weft_session weft_editor weft_cli weft_study
     weft_baselines weft_retrieval weft_shot_bench)
list(FILTER libraries EXCLUDE REGEX "^weft_ui_")
install(TARGETS weft_api ${libraries} EXPORT weft-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/weft COMPONENT development)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/weft)
install(EXPORT weft-targets NAMESPACE weft:: DESTINATION ${config} COMPONENT development)
foreach(folder engine app gpu texture_db)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/weft
            COMPONENT development FILES_MATCHING PATTERN "*.h")
endforeach()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/weftConfig.cmake.in
    ${PROJECT_BINARY_DIR}/weftConfig.cmake INSTALL_DESTINATION ${config})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/weftConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/weftConfig.cmake ${PROJECT_BINARY_DIR}/weftConfigVersion.cmake
        DESTINATION ${config} COMPONENT development)

set(CPACK_PACKAGE_NAME weft)
set(CPACK_PACKAGE_VENDOR "The Weft authors")
set(CPACK_PACKAGE_CONTACT "The Weft authors <weft@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Replace textures in animation")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-inter, fonts-materialdesignicons-webfont")
include(CPack)
