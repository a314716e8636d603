# Defines a target dep::* for each dependency. All come from the distribution's packages; nothing is fetched or vendored.
set(DEP_HINT "run third_party/setup.sh deps")

function(dep name)
  add_library(dep::${name} INTERFACE IMPORTED GLOBAL)
  target_link_libraries(dep::${name} INTERFACE ${ARGN})
endfunction()

# Eigen: no version is requested, because Eigen 5 rejects requests for 3.x.
find_package(Eigen3 REQUIRED NO_MODULE)
dep(eigen Eigen3::Eigen)
# Highway: headers only; sym3/kernel.cpp selects the instruction set.
find_path(HWY_HEADER_DIR hwy/highway.h)
if(NOT HWY_HEADER_DIR)
  message(FATAL_ERROR "Highway (hwy/highway.h) not found: ${DEP_HINT}")
endif()
dep(hwy)
target_include_directories(dep::hwy SYSTEM INTERFACE ${HWY_HEADER_DIR})
target_compile_definitions(dep::hwy INTERFACE HWY_IS_DEBUG_BUILD=0)  # its assertions need its library
find_package(Threads REQUIRED)
dep(threads Threads::Threads)

if(VIETE_BUILD_VIEWER)
  find_package(PkgConfig REQUIRED)

  # Headers only: OpenGL is not linked. render/gl.h loads its functions at run time.
  find_path(GL_HEADER_DIR GL/glcorearb.h)
  find_path(EGL_HEADER_DIR EGL/eglext.h)
  if(NOT GL_HEADER_DIR OR NOT EGL_HEADER_DIR)
    message(FATAL_ERROR "OpenGL or EGL headers not found: ${DEP_HINT}")
  endif()
  dep(gl)
  target_include_directories(dep::gl SYSTEM INTERFACE ${GL_HEADER_DIR} ${EGL_HEADER_DIR})

  find_package(glfw3 3.3 REQUIRED)
  dep(glfw glfw)
  target_compile_definitions(dep::glfw INTERFACE GLFW_INCLUDE_NONE)
  find_package(glm REQUIRED)
  dep(glm glm::glm)
  target_compile_definitions(dep::glm INTERFACE GLM_ENABLE_EXPERIMENTAL)
  pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET GLOBAL imgui>=1.86)
  dep(imgui PkgConfig::IMGUI)
  pkg_check_modules(STB REQUIRED IMPORTED_TARGET GLOBAL stb)
  dep(stb PkgConfig::STB)
  find_package(OpenMesh REQUIRED)
  dep(openmesh OpenMeshCore OpenMeshTools)
  find_package(CLI11 REQUIRED)
  dep(cli11 CLI11::CLI11)
  find_package(nlohmann_json REQUIRED)
  dep(json nlohmann_json::nlohmann_json)
endif()

if(VIETE_BUILD_TESTS)
  find_package(doctest REQUIRED)
  dep(doctest doctest::doctest)
endif()
if(VIETE_BUILD_TESTS AND VIETE_BUILD_VIEWER)
  # An independent glTF reader, for tests.
  find_package(TinyGLTF QUIET)
  if(NOT TARGET TinyGLTF::TinyGLTF)
    message(FATAL_ERROR "TinyGLTF (libtinygltf-dev) not found: ${DEP_HINT}")
  endif()
  dep(tinygltf TinyGLTF::TinyGLTF)
endif()
