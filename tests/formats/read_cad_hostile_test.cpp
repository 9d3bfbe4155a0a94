// SPDX-License-Identifier: Apache-2.0
// IGES, BREP and FCStd files with changed bytes: they are read, or refused with one sentence, and the process survives.
#include "dismantle/files/zip_archive.h"
#include "dismantle/loading/load_assembly.h"

#include "tests/formats/cad_writer.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/zip_writer.h"

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <BinTools.hxx>
#include <random>

namespace dismantle {
namespace {

TopoDS_Shape bored_block() {
  return BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(20.0, 20.0, 10.0).Shape(),
                         BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(10, 10, -1), gp_Dir(0, 0, 1)), 5, 20).Shape())
      .Shape();
}

/// Changes some bytes from `begin` on.
std::string changed(std::string bytes, std::size_t begin, std::string_view alphabet, int round, std::mt19937& random) {
  for (int k = 0; k < 1 + round % 5; ++k)
    bytes[begin + random() % (bytes.size() - begin)] = alphabet[random() % alphabet.size()];
  return bytes;
}

class CadHostile : public ::testing::Test {
 protected:
  void expect_read_or_refused(const std::filesystem::path& file) {
    const Result<Assembly> a = load_assembly(file, {});
    EXPECT_TRUE(a.ok() || a.error().message.find('\n') == std::string::npos) << a.error().message;
    EXPECT_TRUE(a.ok() || a.error().message.find("; ") != std::string::npos) << a.error().message;
    read_ += a.ok() ? 1 : 0;
  }
  void TearDown() override { std::printf("seed %u: %d of the files could still be read\n", kSeed, read_); }

  static constexpr unsigned kSeed = 42;
  std::mt19937 random_{kSeed};
  ScratchFolder folder_;
  int read_ = 0;
};

TEST_F(CadHostile, Iges) {
  for (const auto solids : {CadWriter::IgesSolids::TrimmedSurfaces, CadWriter::IgesSolids::Brep}) {
    CadWriter writer;
    writer.part("block", bored_block());
    ASSERT_TRUE(writer.write_iges(folder_ / "a.igs", solids));
    const std::string whole = bytes_of(folder_ / "a.igs");
    for (int round = 0; round < 25; ++round)
      expect_read_or_refused(folder_.put("b.igs", changed(whole, 81 * 5, "0123456789.,;H-D", round, random_)));
  }
}

TEST_F(CadHostile, Brep) {
  ASSERT_TRUE(BRepTools::Write(bored_block(), (folder_ / "a.brep").c_str()));
  ASSERT_TRUE(BinTools::Write(bored_block(), (folder_ / "a.brp").c_str()));
  for (const char* name : {"a.brep", "a.brp"}) {
    const std::string whole = bytes_of(folder_ / name);
    for (int round = 0; round < 25; ++round)
      expect_read_or_refused(
          folder_.put(std::string("b_") + name, changed(whole, 60, "0123456789 +-.e", round, random_)));
  }
}

TEST_F(CadHostile, FreeCad) {
  const std::string bytes = bytes_of(std::filesystem::path(DISMANTLE_SOURCE_DIR) / "tests/formats/freecad/links.FCStd");
  Result<ZipArchive> archive = ZipArchive::open(bytes);
  ASSERT_TRUE(archive.ok());
  std::vector<std::pair<std::string, std::string>> whole;
  for (const std::string& name : archive->names()) whole.emplace_back(name, *archive->read(name));
  for (int round = 0; round < 40; ++round) {
    auto contents = whole;
    for (auto& [name, text] : contents)
      if (!text.empty()) text = changed(text, 0, "0123456789<>\"/ -.e", round, random_);
    write_zip(folder_ / "b.FCStd", contents);
    expect_read_or_refused(folder_ / "b.FCStd");
    expect_read_or_refused(folder_.put("c.FCStd", changed(bytes, 0, "0123456789PK\x01\x02", round, random_)));
  }
}

}  // namespace
}  // namespace dismantle
