// A small fuzzer for compilers without libFuzzer. Reads the files of the corpus, then changed copies of these
// files. Usage: fuzz FOLDER/FORMAT [SECONDS [SEED]]. Equal seeds give equal inputs. After a crash, the
// file `fuzz-last-input` in the working directory has the input that caused the crash.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;
using Bytes = std::string;

std::vector<Bytes> split(const Bytes& text) {
  std::istringstream in(text);
  std::vector<Bytes> parts;
  for (Bytes part; std::getline(in, part, '|');) parts.push_back(part);
  return parts;
}

const std::vector<Bytes> words = split(
    "4294967295|4294967296|2147483647|-1|0|1e400|1e-400|nan|inf|-inf|\\\n|\r\n||f 1/1/1 2//2 3|v 0 0 0|"
    "element vertex 18446744073709551615|element face 4000000000|property list uchar int vertex_indices|"
    "property list double double x|format binary_big_endian 1.0|format ascii 1.0|end_header\n|OFF|COFF|solid|"
    "endsolid|facet normal|1.0e+100|99999999999999999999999999");

std::vector<Bytes> read_corpus(const fs::path& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> corpus;
  for (const auto& path : paths) {
    std::ifstream in(path, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return corpus;
}

class Mutator {
public:
  Mutator(const std::vector<Bytes>& corpus, std::uint64_t seed) : corpus_(corpus), random_(seed) {}

  Bytes next() {
    Bytes bytes = corpus_[below(corpus_.size())];
    for (std::size_t i = 0, n = 1 + below(6); i < n; ++i) mutate(bytes);
    return bytes;
  }

private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

  void mutate(Bytes& b) {
    const std::size_t at = below(b.size() + 1), length = below(std::min<std::size_t>(b.size() - at, 64) + 1);
    switch (below(8)) {
      case 0:
        if (at < b.size()) b[at] = static_cast<char>(random_());
        break;
      case 1:
        if (at < b.size()) b[at] = static_cast<char>(b[at] ^ (1 << below(8)));
        break;
      case 2: b.erase(at, length); break;
      case 3: b.insert(at, b.substr(at, length)); break;
      case 4: b.insert(at, words[below(words.size())]); break;
      case 5: b.replace(at, length, words[below(words.size())]); break;
      case 6: b.resize(at); break;
      default: splice(b, at); break;
    }
  }

  void splice(Bytes& b, std::size_t at) {
    const Bytes& other = corpus_[below(corpus_.size())];
    const std::size_t from = below(other.size() + 1);
    b.insert(at, other.substr(from, below(200)));
  }

  const std::vector<Bytes>& corpus_;
  std::mt19937_64 random_;
};

void run(const Bytes& bytes) {
  {
    std::ofstream out("fuzz-last-input", std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s FOLDER/FORMAT [SECONDS [SEED]]\n", argv[0]);
    return 2;
  }
  LLVMFuzzerInitialize(&argc, &argv);
  const std::vector<Bytes> corpus = read_corpus(argv[1]);
  if (corpus.empty()) {
    std::fprintf(stderr, "%s: no files\n", argv[1]);
    return 2;
  }
  const double seconds = argc > 2 ? std::atof(argv[2]) : 2;
  for (const auto& bytes : corpus) run(bytes);
  Mutator mutator(corpus, argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::size_t inputs = 0;
  for (; std::chrono::steady_clock::now() < end; ++inputs) run(mutator.next());
  fs::remove("fuzz-last-input");
  std::printf("%zu files of the corpus and %zu damaged ones: no finding\n", corpus.size(), inputs);
  return 0;
}
