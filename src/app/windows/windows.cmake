# viete.exe opens no console. viete.com starts it from a console.
enable_language(RC)
set(VIETE_ICON "" CACHE FILEPATH "Icon of viete.exe, an .ico file")
set(icon_line "")
if(VIETE_ICON)
  set(icon_line "GLFW_ICON ICON \"${VIETE_ICON}\"")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/viete.rc.in viete.rc @ONLY)
target_sources(viete PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/viete.rc)
set_target_properties(viete PROPERTIES WIN32_EXECUTABLE ON)

add_executable(viete-console ${PROJECT_SOURCE_DIR}/src/base/os_windows_console.cpp)
target_link_libraries(viete-console PRIVATE viete_compile)
set_target_properties(viete-console PROPERTIES
  OUTPUT_NAME viete SUFFIX .com RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
if(VIETE_INSTALL)
  install(TARGETS viete-console RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT viewer)
endif()
