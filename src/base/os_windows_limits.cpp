// The functions of base/os.h for the program viete-import, for Windows.
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <io.h>
#include <windows.h>

#include "base/os.h"

namespace viete::base::os {

std::FILE* reserve_output() {
  std::FILE* const file = _fdopen(_dup(_fileno(stdout)), "wb");
  if (file) make_binary(file);  // "b" does not change the mode of an open file
  _dup2(_fileno(stderr), _fileno(stdout));
  return file;
}

void limit_process(double bytes, unsigned seconds) {
  static const HANDLE job = CreateJobObjectW(nullptr, nullptr);  // open until this process ends
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_PROCESS_MEMORY | JOB_OBJECT_LIMIT_PROCESS_TIME |
                                            JOB_OBJECT_LIMIT_DIE_ON_UNHANDLED_EXCEPTION;
  limits.BasicLimitInformation.PerProcessUserTimeLimit.QuadPart = 10'000'000LL * seconds;
  limits.ProcessMemoryLimit = static_cast<SIZE_T>(bytes);
  SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
  AssignProcessToJobObject(job, GetCurrentProcess());
}

}  // namespace viete::base::os
