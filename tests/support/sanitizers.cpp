// How sanitizer builds see graphics drivers, which keep a few bytes per context: libraries stay loaded, so that reports can
// name them, and what they keep is no leak of ours.
extern "C" int dlclose(void*) { return 0; }

extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa\n"
         "leak:libEGL\n"
         "leak:libGLX\n"
         "leak:libX11\n"
         "leak:libgallium\n"
         "leak:_dri.so\n"
         "leak:swrast\n";
}
