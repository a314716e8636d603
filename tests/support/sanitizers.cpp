// Settings of sanitizers. This dlclose() keeps libraries loaded, so that reports can name their functions.
// Reports ignore the memory that graphics drivers do not free.
extern "C" int dlclose(void*) {
  return 0;
}

extern "C" const char* __lsan_default_options() {
  return "print_suppressions=0";
}

extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa\n"
         "leak:libEGL\n"
         "leak:libGLX\n"
         "leak:libX11\n"
         "leak:libgallium\n"
         "leak:_dri.so\n"
         "leak:swrast\n";
}

extern "C" const char* __tsan_default_options() {
  return "detect_deadlocks=0";  // LLVM locks more mutexes at once than the detector supports
}

// These libraries are compiled without the sanitizer, which therefore does not see their locks.
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libOSMesa.so\n"
         "called_from_lib:libEGL_mesa.so\n"
         "called_from_lib:libGLX_mesa.so\n"
         "race:libOSMesa.so\n"
         "race:swrast_dri.so\n"
         "race:libLLVM\n"
         "mutex:libglfw.so\n"
         "mutex:libX11.so\n"
         "mutex:libxcb.so\n";
}
