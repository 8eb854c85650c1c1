// The structure of MCAP files, read by the rules of https://mcap.dev/spec. Other people's reader reads them in
// viewer/page/test/mcap.test.mjs.

#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glissade/apps/record/mcap_writer.h>
#include <glissade/apps/text.h>
#include <glissade/files/text_file.h>

#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using std::chrono::nanoseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

/// CRC-32 bit by bit, as the standard defines it.
std::uint32_t slow_crc(std::string_view bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

/// Reads fields from the start of some bytes.
class McapFields {
 public:
  explicit McapFields(std::string_view bytes) : bytes_(bytes) {}

  template <typename Number>
  Number number() {
    Number value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(take(number<std::uint32_t>())); }
  std::string_view rest() { return take(bytes_.size()); }
  bool is_at_end() const { return bytes_.empty(); }

  std::map<std::uint16_t, std::uint64_t> map() {
    std::map<std::uint16_t, std::uint64_t> result;
    const std::string entries = text();
    for (McapFields fields(entries); !fields.is_at_end();) {
      const auto key = fields.number<std::uint16_t>();
      result[key] = fields.number<std::uint64_t>();
    }
    return result;
  }

  std::string_view take(std::size_t size) {
    EXPECT_LE(size, bytes_.size());
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(taken.size());
    return taken;
  }

 private:
  std::string_view bytes_;
};

struct McapRecord {
  int opcode = 0;
  std::size_t offset = 0;  // in the file, or in the chunk
  std::size_t size = 0;    // with opcode and length
  std::string_view content;
};

std::vector<McapRecord> records_of(std::string_view bytes, std::size_t offset) {
  std::vector<McapRecord> records;
  for (McapFields fields(bytes); !fields.is_at_end();) {
    McapRecord& record = records.emplace_back();
    record.opcode = fields.number<std::uint8_t>();
    record.content = fields.take(fields.number<std::uint64_t>());
    record.offset = offset;
    record.size = 9 + record.content.size();
    offset += record.size;
  }
  return records;
}

constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

/// The file between the magic bytes.
std::vector<McapRecord> records_of_file(std::string_view file) {
  EXPECT_EQ(file.substr(0, 8), kMcapMagic);
  EXPECT_EQ(file.substr(file.size() - 8), kMcapMagic);
  return records_of(file.substr(8, file.size() - 16), 8);
}

std::vector<McapRecord> with_opcode(const std::vector<McapRecord>& records, int opcode) {
  std::vector<McapRecord> found;
  for (const McapRecord& record : records) {
    if (record.opcode == opcode) found.push_back(record);
  }
  return found;
}

class McapFile : public testing::Test {
 protected:
  void end() {
    writer.close();
    file = read_text_file(path);
    records = records_of_file(file);
  }

  test_support::TemporaryFolder folder;
  std::string path = folder.path("test.mcap");
  McapWriter writer{path};
  std::string file;
  std::vector<McapRecord> records;
};

TEST_F(McapFile, HasAChunkItsIndexesAndASummary) {
  const std::uint16_t force = writer.add_channel("/force", "Force", R"({"type":"object"})");
  const std::uint16_t pose = writer.add_channel("/pose", "Pose", R"({"type":"object","title":"Pose"})");
  writer.write(force, nanoseconds(2000), R"({"f_N":1})");
  writer.write(pose, nanoseconds(3000), R"({"x_m":2})");
  writer.write(force, nanoseconds(1000), R"({"f_N":3})");
  end();

  std::vector<int> opcodes;
  for (const McapRecord& record : records)
    opcodes.push_back(record.opcode);
  // Header, chunk, its two indexes, end of data; schemas, channels, statistics, index of the chunk; offsets, footer.
  EXPECT_THAT(opcodes, ElementsAre(1, 6, 7, 7, 15, 3, 3, 4, 4, 11, 8, 14, 14, 14, 14, 2));

  McapFields chunk(records[1].content);
  EXPECT_EQ(chunk.number<std::uint64_t>(), 1000U);
  EXPECT_EQ(chunk.number<std::uint64_t>(), 3000U);
  const auto size = chunk.number<std::uint64_t>();
  const auto crc = chunk.number<std::uint32_t>();
  EXPECT_EQ(chunk.text(), "") << "no compression";
  EXPECT_EQ(chunk.number<std::uint64_t>(), size);
  const std::string_view inner_bytes = chunk.rest();
  EXPECT_EQ(inner_bytes.size(), size);
  EXPECT_EQ(slow_crc(inner_bytes), crc);

  const std::vector<McapRecord> inner = records_of(inner_bytes, 0);
  ASSERT_EQ(inner.size(), 7U);
  McapFields message(inner[6].content);
  EXPECT_EQ(message.number<std::uint16_t>(), force);
  EXPECT_EQ(message.number<std::uint32_t>(), 1U) << "the second one on its channel";
  EXPECT_EQ(message.number<std::uint64_t>(), 1000U);
  EXPECT_EQ(message.number<std::uint64_t>(), 1000U);
  EXPECT_EQ(message.rest(), R"({"f_N":3})");

  McapFields index(records[2].content);
  EXPECT_EQ(index.number<std::uint16_t>(), force);
  const std::string entries = index.text();
  McapFields entry(entries);
  EXPECT_EQ(entry.number<std::uint64_t>(), 2000U);
  EXPECT_EQ(entry.number<std::uint64_t>(), inner[4].offset);
  EXPECT_EQ(entry.number<std::uint64_t>(), 1000U);
  EXPECT_EQ(entry.number<std::uint64_t>(), inner[6].offset);
  EXPECT_TRUE(entry.is_at_end());
}

TEST_F(McapFile, TheSummaryFindsEveryChunk) {
  const std::uint16_t often = writer.add_channel("/often", "Text", "{}");
  const std::uint16_t once = writer.add_channel("/once", "Text", "{}");
  const std::string long_text = '"' + std::string(1000, 'a') + '"';
  writer.write(once, nanoseconds(5), "1");
  for (int i = 0; i < 3000; ++i)
    writer.write(often, nanoseconds(10 + i), long_text);
  end();

  const std::vector<McapRecord> chunks = with_opcode(records, 6);
  const std::vector<McapRecord> indexes = with_opcode(records, 8);
  ASSERT_EQ(chunks.size(), 3U) << "of a megabyte";
  ASSERT_EQ(indexes.size(), chunks.size());
  std::uint64_t next = 5;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    McapFields index(indexes[i].content);
    EXPECT_EQ(index.number<std::uint64_t>(), next);
    const auto last = index.number<std::uint64_t>();
    next = last + 1;
    EXPECT_EQ(index.number<std::uint64_t>(), chunks[i].offset);
    EXPECT_EQ(index.number<std::uint64_t>(), chunks[i].size);
    const std::map<std::uint16_t, std::uint64_t> places = index.map();
    EXPECT_EQ(places.count(once), i == 0 ? 1U : 0U);
    std::uint64_t length = 0;
    for (const McapRecord& record : with_opcode(records, 7)) {
      for (const auto& [channel, place] : places) {
        if (place != record.offset) continue;
        EXPECT_EQ(McapFields(record.content).number<std::uint16_t>(), channel);
        length += record.size;
      }
    }
    EXPECT_EQ(index.number<std::uint64_t>(), length) << "all places are those of index records";
  }
  EXPECT_EQ(next, 3010U);

  McapFields statistics(with_opcode(records, 11).at(0).content);
  EXPECT_EQ(statistics.number<std::uint64_t>(), 3001U);
  EXPECT_EQ(statistics.number<std::uint16_t>(), 1U) << "both channels share a schema";
  EXPECT_EQ(statistics.number<std::uint32_t>(), 2U);
  EXPECT_EQ(statistics.number<std::uint32_t>(), 0U);
  EXPECT_EQ(statistics.number<std::uint32_t>(), 0U);
  EXPECT_EQ(statistics.number<std::uint32_t>(), 3U);
  EXPECT_EQ(statistics.number<std::uint64_t>(), 5U);
  EXPECT_EQ(statistics.number<std::uint64_t>(), 3009U);
  EXPECT_THAT(statistics.map(), ElementsAre(Pair(often, 3000U), Pair(once, 1U)));
}

TEST_F(McapFile, ChecksumsAndOffsetsAreThoseOfTheSpecification) {
  EXPECT_EQ(slow_crc("123456789"), 0xCBF43926U) << "the check value of CRC-32";
  writer.write(writer.add_channel("/a", "A", "{}"), nanoseconds(1), "1");
  end();

  const McapRecord data_end = with_opcode(records, 15).at(0);
  EXPECT_EQ(McapFields(data_end.content).number<std::uint32_t>(), slow_crc(file.substr(0, data_end.offset)));

  McapFields footer(records.back().content);
  const auto summary = footer.number<std::uint64_t>();
  const auto offsets = footer.number<std::uint64_t>();
  EXPECT_EQ(summary, data_end.offset + data_end.size);
  EXPECT_EQ(offsets, with_opcode(records, 14).at(0).offset);
  EXPECT_EQ(footer.number<std::uint32_t>(), slow_crc(file.substr(summary, file.size() - 8 - 4 - summary)));

  std::size_t end_of_group = summary;
  for (const McapRecord& record : with_opcode(records, 14)) {
    McapFields group(record.content);
    const int opcode = group.number<std::uint8_t>();
    const auto start = group.number<std::uint64_t>();
    const auto length = group.number<std::uint64_t>();
    EXPECT_EQ(start, end_of_group);
    end_of_group = start + length;
    for (const McapRecord& inside : records_of(std::string_view(file).substr(start, length), start))
      EXPECT_EQ(inside.opcode, opcode);
  }
  EXPECT_EQ(end_of_group, offsets) << "the groups are all of the summary";
}

TEST_F(McapFile, IsValidWithoutMessages) {
  end();
  EXPECT_THAT(with_opcode(records, 6), testing::IsEmpty());
  EXPECT_EQ(McapFields(with_opcode(records, 11).at(0).content).number<std::uint64_t>(), 0U);
}

TEST(McapWriter, AFileThatCannotBeWrittenIsNamed) {
  const test_support::TemporaryFolder folder;
  try {
    McapWriter writer(folder.path("no/test.mcap"));
    ADD_FAILURE() << "was created";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/test.mcap: cannot be created"));
  }
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  McapWriter writer("/dev/full");
  EXPECT_THROW(writer.close(), std::runtime_error);
}

}  // namespace
}  // namespace glissade::apps
