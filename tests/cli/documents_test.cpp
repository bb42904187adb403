// The documents: every command that they show is run, every link leads somewhere.
//
// A block of ``` or ```sh with a line `meninas ...` or `./meninas ...` is run whole by bash, the blocks of a page
// one after the other in one folder, where gallery, documents and a few files that they talk of are.
// tests/cli/quick_meninas.sh stands for the program: the same options, tiny pictures.
// `<!-- not run: REASON -->` before a block leaves it out; its commands must still be understood.
#include "image/image_file.h"
#include "tests/cli/documents.h"
#include "tests/cli/program.h"
#include "tests/support/source_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace meninas::test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> user_pages() {
  const fs::path root = source_dir();
  std::vector<fs::path> pages{root / "README.md"};
  for (const fs::path& page : pages_of(root / "docs"))
    if (page.filename() != "options.md") // made of the program's own tables
      pages.push_back(page);
  return pages;
}

/// Files that are read stay where they are; what is written beside them is not.
void mirror_folder(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  for (const auto& entry : fs::directory_iterator(from))
    if (entry.is_regular_file())
      fs::create_symlink(entry.path(), to / entry.path().filename());
}

/// The first room with two lamps that pages call by name.
nlohmann::json room_with_lamps(const fs::path& file) {
  auto room = nlohmann::json::parse(std::ifstream(file));
  nlohmann::json second;
  for (nlohmann::json& node : room["nodes"])
    if (node["name"] == "lamp") {
      node["name"] = "desk";
      second = node;
    }
  second["name"] = "reading lamp";
  second["scale"] = {0.3, 0.3, 1};
  second["translation"] = {1.2, 2.4, -1};
  room["scenes"][0]["nodes"].push_back(room["nodes"].size());
  room["nodes"].push_back(second);
  return room;
}

void put_files(const fs::path& folder) {
  const fs::path root = source_dir();
  for (const char* each : {"scenes/gallery", "docs", "reference/images"})
    mirror_folder(root / each, folder / each);
  std::ofstream(folder / "room.gltf") << room_with_lamps(root / "docs/first-room.gltf");
  for (const char* name : {"room.glb", "hall.glb"})
    fs::copy_file(root / "scenes/gallery/blender-room.glb", folder / name);
  std::ofstream(folder / "jobs.json") << R"({"jobs": [{"scenes": "room.gltf",
      "settings": {"size": "32x24", "quality": "draft"}}]})";
  Image studio(8, 4);
  studio.pixels.assign(studio.pixels.size(), glm::vec3(1.0F));
  write_hdr(folder / "studio.hdr", studio);
  fs::create_directories(folder / "bin");
  for (const char* name : {"meninas", "bin/meninas"})
    fs::create_symlink(root / "tests/cli/quick_meninas.sh", folder / name);
}

/// Exit code and command, one a line, of all that a page has run.
class PageRun {
public:
  PageRun() { put_files(folder_.path()); }

  void save(const Block& block) { std::ofstream(folder_ / block.saved_as) << block.text; }

  void run(const Page& page, const Block& block) {
    std::ofstream(folder_ / "block.sh") << "export PATH=\"$PWD/bin:$PATH\" MENINAS_LOG=\"$PWD/log\" MENINAS_PROGRAM='"
                                        << MENINAS_PROGRAM << "'\n" << block.text;
    const Outcome outcome =
        run_other_program("/usr/bin/env", folder_.path(), {"bash", "-e", "block.sh"});
    EXPECT_EQ(outcome.code, 0) << page.file << ", line " << block.line << ":\n"
                               << block.text << outcome.err;
  }

  std::size_t commands() const {
    std::istringstream log(read_file(folder_ / "log"));
    std::size_t count = 0;
    for (std::string line; std::getline(log, line); ++count)
      EXPECT_THAT(line, testing::StartsWith("0 "));
    return count;
  }

private:
  TemporaryFolder folder_;
};

class Documents : public testing::TestWithParam<fs::path> {};

TEST_P(Documents, ShowCommandsThatWork) {
  const Page page = read_page(GetParam());
  PageRun run;
  std::size_t shown = 0;
  for (const Block& block : page.blocks) {
    if (!block.saved_as.empty())
      run.save(block);
    if (!block.not_run.empty() || commands_of(block).empty())
      continue;
    shown += commands_of(block).size();
    run.run(page, block);
  }
  EXPECT_GE(run.commands(), shown);
}

std::vector<fs::path> pages_with_commands() {
  std::vector<fs::path> pages = user_pages();
  std::erase_if(pages, [](const fs::path& file) {
    return std::ranges::all_of(read_page(file).blocks,
                               [](const Block& block) { return commands_of(block).empty(); });
  });
  return pages;
}

INSTANTIATE_TEST_SUITE_P(Pages, Documents, testing::ValuesIn(pages_with_commands()), [](const auto& of) {
  std::string name = of.param.lexically_relative(source_dir()).replace_extension().string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0)
      c = '_';
  return name;
});

// What is not run has to be few, and right: exit code 2 would be a command that is not understood,
// 3 is that its file is not there.
TEST(Document, CommandsThatAreNotRunAreUnderstood) {
  std::size_t all = 0, not_run = 0;
  for (const fs::path& file : user_pages())
    for (const Block& block : read_page(file).blocks)
      for (const std::string& command : commands_of(block)) {
        ++all;
        if (block.not_run.empty())
          continue;
        ++not_run;
        const TemporaryFolder nothing;
        const Outcome outcome = run_other_program(
            "/usr/bin/env", nothing.path(),
            {"JOB_COMPLETION_INDEX=1", "bash", "-c", MENINAS_PROGRAM + (' ' + command)});
        EXPECT_EQ(outcome.code, 3) << file << ": " << command << '\n' << outcome.err;
      }
  EXPECT_GE(all, 60U);
  EXPECT_EQ(not_run, 3U) << "more is left out: say why, and count it here";
}

TEST(Document, CommandsAreInFences) {
  for (const fs::path& file : user_pages())
    for (const std::string& line : read_page(file).prose)
      EXPECT_FALSE(line.starts_with("    meninas ") || line.starts_with("    ./meninas "))
          << file << ": a command that no test runs: " << line;
}

TEST(Document, LinksLeadSomewhere) {
  std::size_t links = 0;
  for (const fs::path& file : pages_of(source_dir())) {
    const Page page = read_page(file);
    for (const std::string& link : links_of(page)) {
      ++links;
      const auto hash = link.find('#');
      const fs::path target = hash == 0 ? file : file.parent_path() / link.substr(0, hash);
      EXPECT_TRUE(fs::exists(target)) << file << ": " << link;
      if (hash != std::string::npos && fs::exists(target)) {
        EXPECT_THAT(anchors_of(read_page(target)), testing::Contains(link.substr(hash + 1)))
            << file << ": " << link;
      }
    }
  }
  EXPECT_GT(links, 200U);
}

/// Whether a file of the checkout is called so: by its whole path or by the last folders of it.
bool is_there(const std::string& source) {
  static const std::vector<std::string> files = [] {
    std::vector<std::string> all;
    const fs::path root = source_dir();
    for (const auto& top : fs::directory_iterator(root))
      if (top.is_directory() && top.path().filename() != "build")
        for (const auto& file : fs::recursive_directory_iterator(top))
          all.push_back('/' + file.path().lexically_relative(root).string());
    return all;
  }();
  return std::ranges::any_of(files,
                             [&](const std::string& file) { return file.ends_with('/' + source); });
}

TEST(Document, SourcesThatAreNamedAreThere) {
  std::vector<fs::path> pages = user_pages();
  pages.push_back(fs::path(source_dir()) / "ARCHITECTURE.md");
  std::size_t sources = 0;
  for (const fs::path& file : pages)
    for (const std::string& source : sources_of(read_page(file))) {
      ++sources;
      EXPECT_TRUE(is_there(source)) << file << ": " << source;
    }
  EXPECT_GT(sources, 200U);
}

TEST(Document, EveryPageIsInTheManual) {
  const std::vector<std::string> links = links_of(read_page(source_dir() + "/docs/README.md"));
  for (const fs::path& file : user_pages()) {
    const std::string page = file.lexically_relative(source_dir() + "/docs").string();
    if (page != "README.md" && !page.starts_with("..")) {
      EXPECT_THAT(links, testing::Contains(page)) << "an order to read in";
    }
  }
}

} // namespace
} // namespace meninas::test
