// SPDX-License-Identifier: Apache-2.0
#include "dismantle/session/journal.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  const std::optional<JournalContents> journal = parse_journal(fuzz::text_of(data, size));
  if (!journal) return 0;
  fuzz::require(journal->whole_bytes <= size, "records within the file");
  fuzz::require(journal->done_count <= journal->entries.size(), "no more in effect than recorded");
  for (const SessionEntry& entry : journal->entries)
    for (const ComponentId c : entry.components)
      fuzz::require(c.value < journal->header.component_count, "components of the assembly");
  const std::optional<JournalContents> again = parse_journal(fuzz::text_of(data, journal->whole_bytes));
  fuzz::require(again && again->entries.size() == journal->entries.size(), "its complete records are a journal");
  return 0;
}
