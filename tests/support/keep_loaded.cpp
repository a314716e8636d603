// In sanitizer builds libraries stay loaded, so that leak reports can name graphics drivers and suppressions can match them.
extern "C" int dlclose(void*) { return 0; }
