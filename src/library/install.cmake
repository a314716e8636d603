# Installs viete::deform: the static libraries of this room and of the listed rooms, and one header, deform.h.
set(rooms base mesh formats foreign cages sparse pose weights deform shapes analysis document files)
foreach(room IN LISTS rooms)
  set_target_properties(viete_${room} PROPERTIES EXPORT_NAME room_${room})
endforeach()
set_target_properties(viete_library PROPERTIES EXPORT_NAME deform)
# Programs link the dependencies of viete::deform, but do not need the headers of the dependencies.
foreach(room IN LISTS rooms)
  get_target_property(linked viete_${room} INTERFACE_LINK_LIBRARIES)
  list(TRANSFORM linked REPLACE "^(dep::.+)" "$<BUILD_INTERFACE:\\1>")
  set_property(TARGET viete_${room} PROPERTY INTERFACE_LINK_LIBRARIES ${linked})
endforeach()
set_property(TARGET viete_mesh APPEND PROPERTY INTERFACE_LINK_LIBRARIES $<INSTALL_INTERFACE:OpenMeshCore>)
set_property(TARGET viete_base APPEND PROPERTY INTERFACE_LINK_LIBRARIES $<INSTALL_INTERFACE:stb>)
set_property(TARGET viete_formats APPEND PROPERTY INTERFACE_LINK_LIBRARIES $<INSTALL_INTERFACE:z>)
list(TRANSFORM rooms PREPEND viete_)
install(TARGETS viete_library ${rooms} EXPORT viete-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
  PUBLIC_HEADER DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/viete COMPONENT library
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
