// SPDX-License-Identifier: Apache-2.0
// Feeds a fuzz target without libFuzzer, in any build: its corpus, and with --seconds also random changes of it, of
// bytes or, where the target has a mutator of its own, of what they mean.
//   replay_TARGET [--seconds S] [--seed N] [--findings FOLDER] CORPUS_FOLDER...
// Where the target crashes, aborts, computes for longer than 20 s or does not return, the input is written to the
// folder, and the exit code is not 0.
#include <fcntl.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
/// Null where the target has none.
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                                                     std::size_t max_size, unsigned seed);

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kLongest = 65536;
constexpr unsigned kSlow = 20;    // of the processor [s]
constexpr unsigned kStuck = 120;  // by the clock: the machine may be busy [s]

Bytes g_input;          // what the target has now
std::string g_finding;  // where it is written
std::mt19937_64 g_random;

void write_finding(int signal_number) {
  const int file = open(g_finding.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file >= 0 && write(file, g_input.data(), g_input.size()) >= 0) close(file);
  std::signal(signal_number, SIG_DFL);
  std::raise(signal_number == SIGALRM || signal_number == SIGPROF ? SIGABRT : signal_number);
}

void run(const Bytes& bytes) {
  g_input = bytes;
  alarm(kStuck);
  const itimerval slow{{0, 0}, {kSlow, 0}}, never{};
  setitimer(ITIMER_PROF, &slow, nullptr);
  LLVMFuzzerTestOneInput(g_input.data(), g_input.size());
  setitimer(ITIMER_PROF, &never, nullptr);
  alarm(0);
}

std::size_t below(std::size_t n) {
  return n == 0 ? 0 : g_random() % n;
}

/// One small change: of a bit, a byte, a run of bytes, or with a part of another input.
void change(Bytes& bytes, const Bytes& other) {
  static constexpr std::uint8_t kSpecial[] = {0, 1, 0x7f, 0x80, 0xff, '0', '9', '-', '.', '"', '{', ']', ' ', '\n'};
  const std::size_t at = below(bytes.size());
  const std::size_t length = std::min(1 + below(16), bytes.size() - std::min(at, bytes.size()));
  const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  switch (below(6)) {
    case 0:
      if (!bytes.empty()) bytes[at] ^= static_cast<std::uint8_t>(1 << below(8));
      break;
    case 1:
      if (!bytes.empty()) bytes[at] = kSpecial[below(std::size(kSpecial))];
      break;
    case 2:
      bytes.erase(place, place + static_cast<std::ptrdiff_t>(length));
      break;
    case 3: {
      const Bytes copy(place, place + static_cast<std::ptrdiff_t>(length));
      bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size() + 1)), copy.begin(), copy.end());
      break;
    }
    case 4:
      bytes.insert(place, static_cast<std::uint8_t>(g_random()));
      break;
    default:
      if (!other.empty()) {
        const std::size_t from = below(other.size()), count = std::min(1 + below(64), other.size() - from);
        const auto piece = other.begin() + static_cast<std::ptrdiff_t>(from);
        bytes.insert(place, piece, piece + static_cast<std::ptrdiff_t>(count));
      }
  }
  if (bytes.size() > kLongest) bytes.resize(kLongest);
}

/// One small change, of what the bytes mean if the target knows it.
void change_by_target(Bytes& bytes, const Bytes& other) {
  if (&LLVMFuzzerCustomMutator == nullptr) return change(bytes, other);
  const std::size_t size = bytes.size();
  bytes.resize(kLongest);
  bytes.resize(LLVMFuzzerCustomMutator(bytes.data(), size, kLongest, static_cast<unsigned>(g_random())));
}

std::vector<Bytes> inputs_in(const std::vector<std::string>& folders) {
  std::vector<std::filesystem::path> files;
  for (const std::string& folder : folders)
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Bytes> inputs;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return inputs;
}

}  // namespace

/// As libFuzzer's, for mutators of targets.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size) {
  Bytes bytes(data, data + size);
  change(bytes, bytes);
  bytes.resize(std::min(bytes.size(), max_size));
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

int main(int argc, char** argv) {
  double seconds = 0;
  std::string findings = ".";
  std::vector<std::string> folders;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&] { return i + 1 < argc ? argv[++i] : ""; };
    if (word == "--seconds")
      seconds = std::atof(value());
    else if (word == "--seed")
      g_random.seed(std::strtoull(value(), nullptr, 10));
    else if (word == "--findings")
      findings = value();
    else
      folders.push_back(word);
  }
  std::error_code ignored;
  std::filesystem::create_directories(findings, ignored);
  g_finding = findings + "/" + std::filesystem::path(argv[0]).filename().string() + ".finding";
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGPROF})
    std::signal(number, write_finding);
  std::vector<Bytes> inputs = inputs_in(folders);
  if (inputs.empty()) {
    std::fputs("no files to replay\n", stderr);
    return 1;
  }
  std::size_t count = inputs.size();
  for (const Bytes& input : inputs) run(input);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  for (; std::chrono::steady_clock::now() < end; ++count) {
    Bytes bytes = inputs[below(inputs.size())];
    for (std::size_t changes = 1 + below(8); changes > 0; --changes)
      change_by_target(bytes, inputs[below(inputs.size())]);
    run(bytes);
  }
  std::printf("%zu inputs, nothing found\n", count);
  return 0;
}
