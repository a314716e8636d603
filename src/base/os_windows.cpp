// base/os.h for Windows 10 and later.
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <aclapi.h>
#include <fcntl.h>
#include <io.h>
#include <malloc.h>
#include <shellapi.h>
#include <windows.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/os.h"

namespace viete::base::os {

namespace {

// UTF-8 to UTF-16, and back.
std::wstring wide(std::string_view text) {
  const int size = MultiByteToWideChar(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), nullptr, 0);
  std::wstring result(static_cast<std::size_t>(size), L'\0');
  MultiByteToWideChar(CP_UTF8, 0, text.data(), static_cast<int>(text.size()), result.data(), size);
  return result;
}

std::string narrow(std::wstring_view text) {
  const auto count = static_cast<int>(text.size());
  const int size = WideCharToMultiByte(CP_UTF8, 0, text.data(), count, nullptr, 0, nullptr, nullptr);
  std::string result(static_cast<std::size_t>(size), '\0');
  WideCharToMultiByte(CP_UTF8, 0, text.data(), count, result.data(), size, nullptr, nullptr);
  return result;
}

// Returns the last error in the words of the C library, which are English.
std::error_code last_error() {
  constexpr std::pair<DWORD, std::errc> known[] = {
      {ERROR_FILE_NOT_FOUND, std::errc::no_such_file_or_directory},
      {ERROR_PATH_NOT_FOUND, std::errc::no_such_file_or_directory},
      {ERROR_FILE_EXISTS, std::errc::file_exists},
      {ERROR_ALREADY_EXISTS, std::errc::file_exists},
      {ERROR_ACCESS_DENIED, std::errc::permission_denied},
      {ERROR_SHARING_VIOLATION, std::errc::permission_denied},
      {ERROR_WRITE_PROTECT, std::errc::permission_denied},
      {ERROR_DISK_FULL, std::errc::no_space_on_device},
      {ERROR_HANDLE_DISK_FULL, std::errc::no_space_on_device},
      {ERROR_FILENAME_EXCED_RANGE, std::errc::filename_too_long},
      {ERROR_INVALID_NAME, std::errc::invalid_argument},
      {ERROR_NOT_ENOUGH_MEMORY, std::errc::not_enough_memory}};
  const DWORD last = GetLastError();
  for (const auto& [number, code] : known)
    if (number == last) return std::make_error_code(code);
  return std::make_error_code(std::errc::io_error);
}

struct CloseHandleOf {
  using pointer = HANDLE;
  void operator()(HANDLE handle) const {
    if (handle != INVALID_HANDLE_VALUE) CloseHandle(handle);
  }
};
using Handle = std::unique_ptr<HANDLE, CloseHandleOf>;

constexpr DWORD share_all = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
bool is_valid(const Handle& handle) {
  return handle && handle.get() != INVALID_HANDLE_VALUE;
}

// A text of the registry's local machine; empty if it is missing.
std::string registry_text(const wchar_t* key, const wchar_t* name) {
  wchar_t text[256];
  DWORD bytes = sizeof text;
  if (RegGetValueW(HKEY_LOCAL_MACHINE, key, name, RRF_RT_REG_SZ, nullptr, text, &bytes) != ERROR_SUCCESS)
    return "";
  return narrow(text);
}

}  // namespace

// ---------------------------------------------------------------- program and environment

// A program with windows has no console of its own. If it was started from a console, attaches to this
// console, to write there and to receive Ctrl+C.
std::vector<std::string> start_program(int, char**) {
  const bool has_output = GetStdHandle(STD_OUTPUT_HANDLE) != nullptr;
  if (AttachConsole(ATTACH_PARENT_PROCESS) && !has_output) {
    for (std::FILE* file : {stdout, stderr}) (void)std::freopen("CONOUT$", "w", file);
  }
  SetConsoleOutputCP(CP_UTF8);
  int count = 0;
  wchar_t** const words = CommandLineToArgvW(GetCommandLineW(), &count);
  std::vector<std::string> arguments;
  for (int i = 1; i < count; ++i) arguments.push_back(narrow(words[i]));
  LocalFree(static_cast<void*>(words));
  return arguments;
}

std::string variable(const char* name) {
  const wchar_t* const value = _wgetenv(wide(name).c_str());
  return value ? narrow(value) : "";
}

void set_variable(const char* name, const char* value) {
  _wputenv_s(wide(name).c_str(), wide(value).c_str());
}

fs::path program_file() {
  std::wstring name(32768, L'\0');
  name.resize(GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size())));
  return name;
}

std::string program_name(std::string_view name) {
  return std::string(name) + ".exe";
}

fs::path home_folder() {
  return variable("USERPROFILE");
}

fs::path state_folder() {
  return variable("LOCALAPPDATA");
}

bool has_display() {
  return true;
}

void open_page(const fs::path& page) {
  const auto result = reinterpret_cast<std::intptr_t>(
      ShellExecuteW(nullptr, L"open", page.c_str(), nullptr, nullptr, SW_SHOWNORMAL));
  if (result <= 32) throw Error(page.string(), "no program opens this page", "open it in a browser");
}

std::tm local_time(std::time_t time) {
  std::tm parts{};
  localtime_s(&parts, &time);
  return parts;
}

bool is_terminal(std::FILE* file) {
  const auto handle = reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(file)));
  DWORD mode = 0;
  return GetConsoleMode(handle, &mode) && SetConsoleMode(handle, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

void make_binary(std::FILE* file) {
  _setmode(_fileno(file), _O_BINARY);
}

// ---------------------------------------------------------------- machine

std::string system_name() {
  return registry_text(L"SOFTWARE\\Microsoft\\Windows NT\\CurrentVersion", L"ProductName");
}

std::string processor_name() {
  std::string name =
      registry_text(L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0", L"ProcessorNameString");
  name.erase(name.find_last_not_of(' ') + 1);
  return name;
}

namespace {

MEMORYSTATUSEX memory_status() {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  GlobalMemoryStatusEx(&status);
  return status;
}

}  // namespace

std::optional<double> total_memory() {
  return static_cast<double>(memory_status().ullTotalPhys);
}

// Windows refuses allocations beyond the memory that can be committed.
std::optional<double> free_memory() {
  const MEMORYSTATUSEX status = memory_status();
  return static_cast<double>(std::min(status.ullAvailPhys, status.ullAvailPageFile));
}

void* allocate_aligned(std::size_t alignment, std::size_t bytes) {
  return _aligned_malloc(bytes, alignment);
}

void free_aligned(void* memory) {
  _aligned_free(memory);
}

void use_large_pages(void*, std::size_t) {}  // they need a privilege that users do not have

void release_freed_memory() {
  _heapmin();
}

void keep_freed_memory() {}

Library::Library(std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (handle_ == nullptr) handle_ = static_cast<void*>(LoadLibraryW(wide(name).c_str()));
  if (handle_ == nullptr) throw Error(*names.begin(), "the library is not installed");
}

void* Library::find(const char* function) const {
  void* const address = reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(handle_), function));
  if (address == nullptr) throw Error(function, "the function is missing in the library");
  return address;
}

// ---------------------------------------------------------------- processes

unsigned long process_id() {
  return GetCurrentProcessId();
}

std::string process_start(unsigned long id) {
  const Handle process(OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION, FALSE, id));
  DWORD code = 0;
  FILETIME created, ended, kernel, user;
  if (!is_valid(process) || !GetExitCodeProcess(process.get(), &code) || code != STILL_ACTIVE ||
      !GetProcessTimes(process.get(), &created, &ended, &kernel, &user))
    return "";
  return std::to_string(std::uint64_t{created.dwHighDateTime} << 32 | created.dwLowDateTime);
}

bool at_fork(void (*)(), void (*)()) {
  return false;
}

namespace {

// Quotes a word as CommandLineToArgvW() reads it: backslashes are doubled before a quotation mark.
std::wstring quoted(const std::wstring& word) {
  if (!word.empty() && word.find_first_of(L" \t\"") == word.npos) return word;
  std::wstring text = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t c : word) {
    if (c == L'"') text.append(backslashes + 1, L'\\');
    backslashes = c == L'\\' ? backslashes + 1 : 0;
    text += c;
  }
  return text.append(backslashes, L'\\') + L'"';
}

std::wstring command_line(const std::vector<std::string>& words) {
  std::wstring line;
  for (const std::string& word : words) line += (line.empty() ? L"" : L" ") + quoted(wide(word));
  return line;
}

// The environment of this process with further variables, as CreateProcessW() reads it.
std::wstring environment(const std::vector<std::string>& variables) {
  std::wstring block;
  for (const std::string& variable : variables) block += wide(variable) + L'\0';
  wchar_t* const own = GetEnvironmentStringsW();
  for (const wchar_t* entry = own; *entry; entry += wcslen(entry) + 1) block += std::wstring(entry) + L'\0';
  FreeEnvironmentStringsW(own);
  return block + L'\0';
}

Handle open_inheritable(const fs::path& file, DWORD access, DWORD disposition, DWORD flags) {
  SECURITY_ATTRIBUTES inherit{sizeof inherit, nullptr, TRUE};
  return Handle(CreateFileW(file.c_str(), access, share_all, &inherit, disposition, flags, nullptr));
}

// A file for the output or the errors of a child. It disappears when it is closed.
Handle unnamed_file() {
  static std::atomic<int> number = 0;
  std::error_code ignored;
  const fs::path file = fs::temp_directory_path(ignored) / ("viete-" + std::to_string(process_id()) + "-" +
                                                            std::to_string(number++) + ".output");
  return open_inheritable(file, GENERIC_READ | GENERIC_WRITE, CREATE_ALWAYS,
                          FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE);
}

struct Files {
  HANDLE input, output, errors;
};

// Starts a program with these files. Returns its process, or null.
Handle start(const std::vector<std::string>& words, const Files& files, DWORD flags, HANDLE job = nullptr,
             const std::vector<std::string>& variables = {}) {
  std::wstring line = command_line(words), block = environment(variables);
  STARTUPINFOW startup{};
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  startup.hStdInput = files.input;
  startup.hStdOutput = files.output;
  startup.hStdError = files.errors;
  PROCESS_INFORMATION started{};
  if (!CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE,
                      flags | CREATE_UNICODE_ENVIRONMENT | CREATE_SUSPENDED, block.data(), nullptr, &startup,
                      &started))
    return nullptr;
  if (job) AssignProcessToJobObject(job, started.hProcess);
  ResumeThread(started.hThread);
  CloseHandle(started.hThread);
  return Handle(started.hProcess);
}

// Waits for a process with the files of this one. Returns its exit code; nullopt if it cannot be started.
std::optional<DWORD> exit_code_of(const std::vector<std::string>& words, const Files& files) {
  for (HANDLE file : {files.input, files.output, files.errors})
    SetHandleInformation(file, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  const Handle process = start(words, files, 0);
  if (!process) return std::nullopt;
  WaitForSingleObject(process.get(), INFINITE);
  DWORD code = 1;
  GetExitCodeProcess(process.get(), &code);
  return code;
}

// The name of the event that asks a process to end.
std::wstring end_event_name(DWORD process) {
  return L"Local\\viete-end-" + std::to_wstring(process);
}

}  // namespace

struct Child::State {
  Handle errors = unnamed_file(), output, job{CreateJobObjectW(nullptr, nullptr)}, process;
};

Child::Child(const std::vector<std::string>& words, const std::vector<std::string>& variables,
             bool keeps_output)
    : state_(std::make_unique<State>()) {
  if (keeps_output) state_->output = unnamed_file();
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  SetInformationJobObject(state_->job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
  const Handle nothing = open_inheritable(L"NUL", GENERIC_READ | GENERIC_WRITE, OPEN_EXISTING, 0);
  state_->process =
      start(words, {nothing.get(), (keeps_output ? state_->output : nothing).get(), state_->errors.get()},
            CREATE_NEW_PROCESS_GROUP | CREATE_NO_WINDOW, state_->job.get(), variables);
  if (state_->process) return;
  const std::error_code code = last_error();
  throw StartFailure{code.message(), code == std::errc::no_such_file_or_directory,
                     code == std::errc::not_enough_memory};
}

Child::~Child() = default;  // closing the job kills the process and its children

bool Child::running() {
  return WaitForSingleObject(state_->process.get(), 0) == WAIT_TIMEOUT;
}

bool Child::succeeded() const {
  DWORD code = 1;
  return GetExitCodeProcess(state_->process.get(), &code) && code == 0;
}

void Child::ask_to_end() {
  const DWORD id = GetProcessId(state_->process.get());
  const Handle event(OpenEventW(EVENT_MODIFY_STATE, FALSE, end_event_name(id).c_str()));
  if (event)
    SetEvent(event.get());
  else
    TerminateProcess(state_->process.get(), 1);
}

namespace {

// Returns the first `most` bytes of a file, at most 4 GB.
std::string beginning_of(const Handle& file, std::uint64_t most) {
  std::string text(static_cast<std::size_t>(std::min<std::uint64_t>(most, MAXDWORD)), '\0');
  OVERLAPPED begin{};
  DWORD got = 0;
  (void)ReadFile(file.get(), text.data(), static_cast<DWORD>(text.size()), &got, &begin);
  text.resize(got);
  return text;
}

}  // namespace

std::string Child::errors(std::size_t most) const {
  std::string text = beginning_of(state_->errors, most);
  std::erase(text, '\r');
  return text;
}

std::string Child::output() const {
  LARGE_INTEGER size{};
  if (!state_->output || !GetFileSizeEx(state_->output.get(), &size)) return "";
  return beginning_of(state_->output, static_cast<std::uint64_t>(size.QuadPart));
}

bool run_and_wait(const std::vector<std::string>& words) {
  const HANDLE errors = GetStdHandle(STD_ERROR_HANDLE);
  return exit_code_of(words, {GetStdHandle(STD_INPUT_HANDLE), errors, errors}).has_value();
}

std::string replace_process(const std::vector<std::string>& words) {
  const auto code = exit_code_of(words, {GetStdHandle(STD_INPUT_HANDLE), GetStdHandle(STD_OUTPUT_HANDLE),
                                         GetStdHandle(STD_ERROR_HANDLE)});
  if (code) std::_Exit(static_cast<int>(*code));
  return last_error().message();
}

namespace {

std::atomic<void (*)()> clean_up_at_end = nullptr;
std::atomic<HANDLE> end_requested = nullptr;  // the event of the EndRequests, or null

// Runs in a thread of its own. After a closed console, Windows ends the process when this function returns.
BOOL WINAPI take_console_event(DWORD event) {
  if (const HANDLE requested = end_requested) {
    SetEvent(requested);
    if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) Sleep(5000);
    return TRUE;
  }
  if (const auto clean_up = clean_up_at_end.load()) clean_up();
  return FALSE;
}

}  // namespace

void at_end(void (*clean_up)()) {
  clean_up_at_end = clean_up;
  SetConsoleCtrlHandler(take_console_event, TRUE);
}

void remove_at_end(const fs::path::value_type* file) {
  DeleteFileW(file);
}

struct EndRequests::State {
  Handle requested{CreateEventW(nullptr, FALSE, FALSE, end_event_name(GetCurrentProcessId()).c_str())},
      stopped{CreateEventW(nullptr, TRUE, FALSE, nullptr)};
  std::jthread thread;
};

EndRequests::EndRequests(std::function<void()> act) : state_(std::make_unique<State>()) {
  try {
    state_->thread = std::jthread([act = std::move(act), s = state_.get()] {
      const HANDLE events[] = {s->stopped.get(), s->requested.get()};
      while (WaitForMultipleObjects(2, events, FALSE, INFINITE) == WAIT_OBJECT_0 + 1) act();
    });
    end_requested = state_->requested.get();
    SetConsoleCtrlHandler(take_console_event, TRUE);
  } catch (const std::system_error&) {  // no thread can be created
  }
}

EndRequests::~EndRequests() {
  end_requested = nullptr;
  SetEvent(state_->stopped.get());
  if (state_->thread.joinable()) state_->thread.join();
}

void EndRequests::end_process() {
  if (const auto clean_up = clean_up_at_end.load()) clean_up();
  std::_Exit(130);
}

// ---------------------------------------------------------------- files

namespace {

std::optional<BY_HANDLE_FILE_INFORMATION> information(const fs::path& file) {
  const Handle handle(CreateFileW(file.c_str(), FILE_READ_ATTRIBUTES, share_all, nullptr, OPEN_EXISTING,
                                  FILE_FLAG_BACKUP_SEMANTICS, nullptr));
  BY_HANDLE_FILE_INFORMATION found;
  if (!is_valid(handle) || !GetFileInformationByHandle(handle.get(), &found)) return std::nullopt;
  return found;
}

}  // namespace

std::optional<FileId> file_id(const fs::path& file) {
  const auto found = information(file);
  if (!found) return std::nullopt;
  return FileId(found->dwVolumeSerialNumber,
                std::uint64_t{found->nFileIndexHigh} << 32 | found->nFileIndexLow);
}

std::uintmax_t count_names(const fs::path& file) {
  const auto found = information(file);
  return found ? found->nNumberOfLinks : 1;
}

const char* const way_to_make_writable = "Properties, Read-only";

bool is_write_protected(const fs::path& file) {
  const DWORD attributes = GetFileAttributesW(file.c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES) return false;
  if (attributes & FILE_ATTRIBUTE_READONLY) return true;
  const Handle handle(
      CreateFileW(file.c_str(), GENERIC_WRITE, share_all, nullptr, OPEN_EXISTING, 0, nullptr));
  return !is_valid(handle) && GetLastError() == ERROR_ACCESS_DENIED;
}

bool is_device_name(const fs::path& file) {
  std::string name = file.filename().string();
  name.erase(std::min(name.find('.'), name.size()));
  name.erase(name.find_last_not_of(' ') + 1);
  std::ranges::transform(name, name.begin(), [](char c) { return c >= 'a' && c <= 'z' ? char(c - 32) : c; });
  if (name == "CON" || name == "PRN" || name == "AUX" || name == "NUL") return true;
  return name.size() == 4 && (name.starts_with("COM") || name.starts_with("LPT")) && name[3] >= '1' &&
         name[3] <= '9';
}

// A NewFile does not share writing, so its file cannot be opened here.
void remove_unless_held(const fs::path& file) {
  Handle handle(CreateFileW(file.c_str(), GENERIC_WRITE, 0, nullptr, OPEN_EXISTING,
                            FILE_FLAG_OPEN_REPARSE_POINT, nullptr));
  if (!is_valid(handle)) return;
  handle.reset();
  DeleteFileW(file.c_str());
}

bool is_disk_full(const std::error_code& code) {
  return code == std::errc::no_space_on_device;
}

void sync_folder(const fs::path&) {}  // NTFS logs renames

std::error_code NewFile::create(const fs::path& file, const fs::path&) {
  const HANDLE handle = CreateFileW(file.c_str(), GENERIC_WRITE | DELETE | WRITE_DAC,
                                    FILE_SHARE_READ | FILE_SHARE_DELETE, nullptr, CREATE_NEW, 0, nullptr);
  handle_ = reinterpret_cast<std::intptr_t>(handle);  // INVALID_HANDLE_VALUE is -1
  return is_open() ? std::error_code() : last_error();
}

std::error_code NewFile::write(std::string_view bytes) {
  constexpr std::size_t most = 1 << 26;
  while (!bytes.empty()) {
    DWORD written = 0;
    if (!WriteFile(reinterpret_cast<HANDLE>(handle_), bytes.data(),
                   static_cast<DWORD>(std::min(bytes.size(), most)), &written, nullptr))
      return last_error();
    bytes.remove_prefix(written);
  }
  return {};
}

// Copies the access list. A failure is no error: the file then has the rights of its folder.
std::error_code NewFile::take_rights(const fs::path& existing) {
  PACL list = nullptr;
  PSECURITY_DESCRIPTOR descriptor = nullptr;
  if (GetNamedSecurityInfoW(existing.c_str(), SE_FILE_OBJECT, DACL_SECURITY_INFORMATION, nullptr, nullptr,
                            &list, nullptr, &descriptor) != ERROR_SUCCESS)
    return {};
  SetSecurityInfo(reinterpret_cast<HANDLE>(handle_), SE_FILE_OBJECT, DACL_SECURITY_INFORMATION, nullptr,
                  nullptr, list, nullptr);
  LocalFree(descriptor);
  return {};
}

std::error_code NewFile::flush_to_disk() {
  return FlushFileBuffers(reinterpret_cast<HANDLE>(handle_)) ? std::error_code() : last_error();
}

std::error_code NewFile::close() {
  if (!is_open()) return {};
  const auto handle = reinterpret_cast<HANDLE>(std::exchange(handle_, none));
  return CloseHandle(handle) ? std::error_code() : last_error();
}

InputFile::InputFile(const fs::path& file)
    : handle_(reinterpret_cast<std::intptr_t>(
          CreateFileW(file.c_str(), GENERIC_READ, share_all, nullptr, OPEN_EXISTING, 0, nullptr))) {
  if (handle_ == -1) throw std::system_error(last_error());
}

InputFile::~InputFile() {
  CloseHandle(reinterpret_cast<HANDLE>(handle_));
}

bool InputFile::read(std::uint64_t position, char* bytes, std::size_t count) const {
  OVERLAPPED at{};
  at.Offset = static_cast<DWORD>(position);
  at.OffsetHigh = static_cast<DWORD>(position >> 32);
  DWORD got = 0;
  return ReadFile(reinterpret_cast<HANDLE>(handle_), bytes, static_cast<DWORD>(count), &got, &at) &&
         got == count;
}

}  // namespace viete::base::os
