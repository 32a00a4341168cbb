#include "saved/section_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>

#include "boxwood/error.h"
#include "files/output_file.h"
#include "saved/checksum.h"

namespace boxwood {
namespace {

constexpr std::array<char, 8> magic = {'B', 'O', 'X', 'W', 'T', 'R', 'E', 'E'};
/// Raise it when a section's meaning or a layout's nodes change.
constexpr std::uint32_t current_version = 1;
/// Reads as 1 only where bytes have the writer's order.
constexpr std::uint32_t byte_order_mark = 1;
constexpr std::size_t alignment = 64;

struct FileHeader {
  std::array<char, 8> magic;
  std::uint32_t byte_order, version;
  std::uint64_t file_bytes;
  std::uint64_t sections;
  std::uint64_t table_checksum;
  std::uint64_t zero[2];
  std::uint64_t checksum;  ///< of the 56 bytes before
};
static_assert(sizeof(FileHeader) == 64);

struct TableEntry {
  SectionKind kind;
  std::uint32_t zero;
  std::uint64_t offset;    ///< from the file's start
  std::uint64_t bytes;     ///< without the zeros that fill up its last cache line
  std::uint64_t checksum;  ///< of the section with these zeros
};
static_assert(sizeof(TableEntry) == 32);

constexpr std::uint64_t padded(std::uint64_t bytes) { return (bytes + alignment - 1) / alignment * alignment; }

std::uint64_t checksum_of(const FileHeader& header) {
  return block_checksum(std::as_bytes(std::span(&header, 1)).first(offsetof(FileHeader, checksum)));
}

/// Of a section and its padding: that of its whole cache lines, then that of the last one.
std::uint64_t section_checksum(std::span<const std::byte> bytes) {
  const std::size_t whole = bytes.size() / alignment * alignment;
  std::array<std::byte, alignment + 8> end{};
  if (whole < bytes.size()) std::memcpy(end.data(), bytes.data() + whole, bytes.size() - whole);
  const std::uint64_t sum = block_checksum(bytes.first(whole));
  std::memcpy(end.data() + alignment, &sum, sizeof sum);
  return block_checksum(end);
}

bool is_zero(std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) {
    if (byte != std::byte{0}) return false;
  }
  return true;
}

void write_padded(OutputFile& out, std::span<const std::byte> bytes) {
  static constexpr std::array<std::byte, alignment> zeros{};
  out.write(bytes);
  out.write(std::span(zeros).first(padded(bytes.size()) - bytes.size()));
}

}  // namespace

void write_sections(const std::filesystem::path& file, std::span<const Section> sections) {
  std::vector<TableEntry> table;
  std::uint64_t offset = padded(sizeof(FileHeader) + sections.size() * sizeof(TableEntry));
  for (const Section& section : sections) {
    table.push_back({section.kind, 0, offset, section.bytes.size(), section_checksum(section.bytes)});
    offset += padded(section.bytes.size());
  }
  FileHeader header{magic, byte_order_mark, current_version, offset, sections.size(), 0, {}, 0};
  header.table_checksum = block_checksum(std::as_bytes(std::span(table)));
  header.checksum = checksum_of(header);
  OutputFile out(file);
  out.write(std::as_bytes(std::span(&header, 1)));
  write_padded(out, std::as_bytes(std::span(table)));
  for (const Section& section : sections) write_padded(out, section.bytes);
  out.commit();
}

SectionFile::SectionFile(const std::filesystem::path& file, bool verify)
    : name_(file.string()), mapped_(map_file(file)) {
  const std::span<const std::byte> all = mapped_.bytes;
  FileHeader header;
  if (all.size() < sizeof header) fail("it ends within its header");
  std::memcpy(&header, all.data(), sizeof header);
  if (header.magic != magic) fail("it does not begin with BOXWTREE");
  if (header.byte_order != byte_order_mark) fail("it was written by a machine with another order of bytes");
  if (header.version != current_version) {
    fail(fmt::format("it has version {}; this program reads version {}", header.version, current_version));
  }
  if (header.checksum != checksum_of(header)) fail("its header is damaged");
  if (header.file_bytes != all.size()) {
    fail(fmt::format("it has {} bytes, not the {} that it was written with", all.size(), header.file_bytes));
  }
  if (header.sections > (all.size() - sizeof header) / sizeof(TableEntry)) fail("its table is longer than the file");

  const auto table_bytes = all.subspan(sizeof header, header.sections * sizeof(TableEntry));
  if (block_checksum(table_bytes) != header.table_checksum) fail("its table of sections is damaged");
  const TableEntry* table = reinterpret_cast<const TableEntry*>(table_bytes.data());
  std::uint64_t offset = padded(sizeof header + table_bytes.size());
  if (offset > all.size() ||
      !is_zero(all.subspan(sizeof header + table_bytes.size(), offset - sizeof header - table_bytes.size()))) {
    fail("its table of sections is damaged");
  }
  for (std::uint64_t i = 0; i < header.sections; ++i) {
    const TableEntry& entry = table[i];
    if (entry.offset != offset || entry.zero != 0 || entry.bytes > all.size() - offset ||
        padded(entry.bytes) > all.size() - offset) {
      fail(fmt::format("section {} does not lie where it should", i));
    }
    sections_.push_back({entry.kind, all.subspan(offset, entry.bytes)});
    offset += padded(entry.bytes);
    if (!verify) continue;
    const std::size_t end = entry.offset + entry.bytes;
    if (section_checksum(sections_.back().bytes) != entry.checksum || !is_zero(all.subspan(end, offset - end))) {
      fail(fmt::format("section {}, at byte {}, does not match its checksum", i, entry.offset));
    }
  }
  if (offset != all.size()) fail(fmt::format("{} bytes follow its last section", all.size() - offset));
}

std::span<const std::byte> SectionFile::next(SectionKind kind) {
  if (at_end() || sections_[position_].kind != kind) {
    fail(fmt::format("section {} is missing or of another kind", position_));
  }
  return sections_[position_++].bytes;
}

void SectionFile::fail(std::string_view problem) const {
  throw Error(
      fmt::format("'{}' is not a usable saved structure: {}; make it anew with 'boxwood build'", name_, problem));
}

}  // namespace boxwood
