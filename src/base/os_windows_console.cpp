// viete.com: starts viete.exe from a console, and waits for it. A console does not wait for a program that
// may open windows, and a program for consoles opens a console when it is started by a double click.
#include <windows.h>

#include <cstdio>
#include <string>

namespace {

BOOL WINAPI leave_to_program(DWORD) {
  return TRUE;
}

// Returns the part of a command line after the program's name.
const wchar_t* after_program(const wchar_t* line) {
  bool quoted = false;
  for (; *line && (quoted || (*line != L' ' && *line != L'\t')); ++line)
    if (*line == L'"') quoted = !quoted;
  return line;
}

}  // namespace

int main() {
  std::wstring program(32768, L'\0');
  program.resize(GetModuleFileNameW(nullptr, program.data(), static_cast<DWORD>(program.size())));
  program.replace(program.rfind(L'.'), program.npos, L".exe");
  std::wstring line = L'"' + program + L'"' + after_program(GetCommandLineW());
  STARTUPINFOW startup{};
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  startup.hStdInput = GetStdHandle(STD_INPUT_HANDLE);
  startup.hStdOutput = GetStdHandle(STD_OUTPUT_HANDLE);
  startup.hStdError = GetStdHandle(STD_ERROR_HANDLE);
  for (const HANDLE file : {startup.hStdInput, startup.hStdOutput, startup.hStdError})
    SetHandleInformation(file, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  SetConsoleCtrlHandler(leave_to_program, TRUE);
  PROCESS_INFORMATION started{};
  if (!CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &startup,
                      &started)) {
    std::fputs("viete: viete.exe must be in the folder of viete.com; unpack both\n", stderr);
    return 1;
  }
  WaitForSingleObject(started.hProcess, INFINITE);
  DWORD code = 1;
  GetExitCodeProcess(started.hProcess, &code);
  return static_cast<int>(code);
}
