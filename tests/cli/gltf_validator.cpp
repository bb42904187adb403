#include "tests/cli/gltf_validator.h"

#include "tests/cli/program.h"

#include <gtest/gtest.h>

namespace meninas::test {
namespace {

/// `npm install --global gltf-validator` has put it beside the other packages of Node.
constexpr const char* validate = R"(
const fs = require('fs'), { execSync } = require('child_process');
let validator;
try { validator = require('gltf-validator'); } catch {
  try { validator = require(execSync('npm root --global').toString().trim() + '/gltf-validator'); }
  catch { console.log('null'); process.exit(0); }
}
Promise.all(process.argv.slice(1).map(async file => {
  const { issues } = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { maxIssues: 0 });
  return [file, issues.numErrors, issues.numWarnings, issues.messages.filter(m => m.severity < 2).map(m => `${m.code} ${m.pointer}`).join('; ')];
})).then(said => console.log(JSON.stringify(said)));
)";

} // namespace

bool has_gltf_validator(const std::filesystem::path& folder) {
  const Outcome said = run_other_program("node", folder, {"-e", validate});
  return said.code == 0 && said.out != "null\n";
}

nlohmann::json validator_findings(const std::filesystem::path& folder, const std::vector<std::string>& files) {
  std::vector<std::string> arguments{"-e", validate};
  arguments.insert(arguments.end(), files.begin(), files.end());
  const Outcome said = run_other_program("node", folder, arguments);
  nlohmann::json findings = nlohmann::json::parse(said.out);
  EXPECT_EQ(findings.size(), files.size()) << said.err;
  return findings;
}

} // namespace meninas::test
