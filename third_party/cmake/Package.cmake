# Packages for Debian and Ubuntu, made by `cpack` in the build folder: `viete`, the program; `libviete-dev`, libraries and headers;
# if built, `python3-viete`, the Python module, and `blender-viete`, the Blender add-on.

set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/before_packing.cmake)
set(CPACK_VIETE_KERNELS ${VIETE_KERNELS})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGE_CONTACT "The Viete authors <viete@viete.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # would precede the summary of each package
set(CPACK_SOURCE_IGNORE_FILES "/\\.git" "/\\.cache/" "/build")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Required by Debian only: a copyright file in each package, a compressed manual page, zsh's completion in another folder.
function(install_debian component folder)
  install(FILES ${ARGN} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder} COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()
set(copyright ${CMAKE_CURRENT_LIST_DIR}/copyright)
execute_process(COMMAND gzip -9nc ${CMAKE_CURRENT_LIST_DIR}/changelog.debian OUTPUT_FILE ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)
set(documents ${copyright} ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)

set(CPACK_COMPONENTS_ALL library library_debian)
set(CPACK_COMPONENT_LIBRARY_GROUP library)
set(CPACK_COMPONENT_LIBRARY_DEBIAN_GROUP library)
install_debian(library_debian doc/libviete-dev ${documents})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libviete-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "g++, cmake | pkgconf, libeigen3-dev, libhwy-dev")
if(VIETE_BUILD_VIEWER)
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "libopenmesh-dev, libstb-dev, zlib1g-dev")  # linked by viete::deform
endif()
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "functions of symmetric 3x3 matrices, one or millions
Exponential, logarithm, roots, powers and eigenvalues of symmetric 3x3
matrices, rotations and polar decomposition, in vector code chosen at run
time: C++20 headers and a static library.")

if(VIETE_BUILD_VIEWER)
  list(APPEND CPACK_COMPONENTS_ALL viewer viewer_debian)
  set(CPACK_COMPONENT_VIEWER_GROUP program)
  set(CPACK_COMPONENT_VIEWER_DEBIAN_GROUP program)
  install_debian(viewer_debian doc/viete ${documents})
  install_debian(viewer_debian man/man1 ${PROJECT_BINARY_DIR}/assets/desktop/viete.1.gz)
  # One page documents all programs.
  foreach(program viete-bench viete-import)
    if(TARGET ${program})
      file(CREATE_LINK viete.1.gz ${CMAKE_CURRENT_BINARY_DIR}/${program}.1.gz SYMBOLIC)
      install_debian(viewer_debian man/man1 ${CMAKE_CURRENT_BINARY_DIR}/${program}.1.gz)
    endif()
  endforeach()
  install_debian(viewer_debian zsh/vendor-completions ${PROJECT_SOURCE_DIR}/assets/desktop/completion/viete.zsh RENAME _viete)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME viete)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg")  # makes films from numbered pictures
  # SHLIBDEPS finds the linked libraries. DEPENDS lists the libraries that the program opens at run time.
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libgl1, libegl1 | libosmesa6")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
    "libgl1-mesa-dri, libfontconfig1, libxcursor1, libxi6, libxinerama1, libxrandr2, fonts-inter, fonts-jetbrains-mono")
  set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "deform a mesh by dragging the cage around it
Drag the cage: the mesh follows in the same frame. Panels show the time and
error of every stage. The command line renders pictures, deforms meshes and
runs benchmarks.")
endif()

if(VIETE_BUILD_PYTHON AND VIETE_BUILD_VIEWER)
  list(APPEND CPACK_COMPONENTS_ALL python_debian blender_debian)
  set(CPACK_COMPONENT_PYTHON_DEBIAN_GROUP python)
  set(CPACK_COMPONENT_BLENDER_DEBIAN_GROUP blender)
  # The module folder of Debian packages. `cmake --install` uses VIETE_PYTHON_DIR instead.
  set(modules lib/python3/dist-packages)
  install(TARGETS viete_python LIBRARY DESTINATION ${modules} COMPONENT python_debian EXCLUDE_FROM_ALL)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/python/viete-stubs DESTINATION ${modules} COMPONENT python_debian EXCLUDE_FROM_ALL)
  install_debian(python_debian doc/python3-viete ${documents} ${PROJECT_SOURCE_DIR}/src/python/README.md)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/python/gallery DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-viete COMPONENT python_debian
    EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.py" PATTERN "*.md")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-viete)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "viete")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "deform meshes by cages, and functions of 3x3 matrices
The deformer of viete on numpy arrays: cages, shapes and poses in log space,
sessions; and exp, log, roots and derivatives of symmetric 3x3 matrices in
vector code.")
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/blender/viete_cage DESTINATION ${CMAKE_INSTALL_DATADIR}/blender/scripts/addons
    COMPONENT blender_debian EXCLUDE_FROM_ALL FILES_MATCHING PATTERN "*.py")
  install_debian(blender_debian doc/blender-viete ${documents} ${PROJECT_SOURCE_DIR}/assets/manual/blender.md)
  set(CPACK_DEBIAN_BLENDER_PACKAGE_NAME blender-viete)
  set(CPACK_DEBIAN_BLENDER_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_BLENDER_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_BLENDER_PACKAGE_DEPENDS "blender (>= 3.4), python3-viete (>= ${PROJECT_VERSION})")
  set(CPACK_DEBIAN_BLENDER_DESCRIPTION "add-on for Blender: deform an object by a cage
Live updates while the cage is edited or animated by shape keys, armatures and
modifiers; bakes to shape keys, a point cache or a mesh.")
endif()

include(CPack)
