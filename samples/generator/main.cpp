// SPDX-License-Identifier: Apache-2.0
#include "dismantle/documents/motion_file.h"
#include "samples/generator/sample_motion.h"
#include "samples/generator/samples.h"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>
#include <cstdio>
#include <exception>
#include <filesystem>

// dismantle_samples FOLDER [NAME...]: writes NAME.step and NAME.motion.json of the named samples (all without names).
int main(int argc, char** argv) {
  using namespace dismantle::samples;
  if (argc < 2) {
    std::fprintf(stderr, "usage: dismantle_samples FOLDER [NAME...]\n");
    return 2;
  }
  Message::DefaultMessenger()->ChangePrinters().Clear();
  const std::filesystem::path folder = argv[1];
  std::vector<std::string> names(argv + 2, argv + argc);
  if (names.empty()) names = sample_names();
  try {
    for (const std::string& name : names) {
      const SampleModel model = make_sample(name);
      model.write_step(folder / (name + ".step"));
      const auto written = dismantle::write_motion(folder / (name + ".motion.json"), make_sample_motion(name));
      if (!written) throw std::runtime_error(written.error().message);
      std::printf("%s: %zu components\n", name.c_str(), model.occurrences().size());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dismantle_samples: %s\n", error.what());
    return 1;
  } catch (const Standard_Failure& failure) {
    std::fprintf(stderr, "dismantle_samples: OpenCASCADE failed: %s\n", failure.GetMessageString());
    return 1;
  }
  return 0;
}
