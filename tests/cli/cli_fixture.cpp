// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/cli_fixture.h"

#include <sys/wait.h>

namespace dismantle {

Outcome Cli::run(const std::string& arguments) const {
  const std::string command = std::string("cd '") + folder_.string() +
                              "' && XDG_CACHE_HOME=\"$PWD/cache\" '" DISMANTLE_PROGRAM "' " + arguments + " >'" +
                              in("stdout").string() + "' 2>'" + in("stderr").string() + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_all(in("stdout")),
          read_all(in("stderr"))};
}

}  // namespace dismantle
