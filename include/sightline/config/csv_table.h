#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sightline/config/node.h"

namespace sightline::config {

/// A text file of comma-separated columns. The first line names them, in any order; columns nobody
/// asks for are left alone. Blank lines and lines that start with # are skipped. Whatever is wrong
/// is thrown as Error with file, line and column.
class CsvTable {
 public:
  static CsvTable readFile(const std::string& path);
  static CsvTable parse(const std::string& text, const std::string& source);

  bool has(const std::string& column) const;
  std::size_t rows() const { return rows_.size(); }
  const std::string& source() const { return source_; }

  /// One line below the header. It must not outlive its table.
  class Row {
   public:
    Row(const CsvTable& table, std::size_t index) : table_(&table), index_(index) {}

    const std::string& text(const std::string& column) const;
    /// A finite number.
    double number(const std::string& column, Range range = {}) const;
    int integer(const std::string& column, Range range = {}) const;
    [[noreturn]] void fail(const std::string& column, const std::string& reason) const;

   private:
    const CsvTable* table_;
    std::size_t index_;
  };
  Row row(std::size_t index) const { return {*this, index}; }

 private:
  struct Line {
    int number;
    std::vector<std::string> cells;
  };
  CsvTable(std::string source) : source_(std::move(source)) {}
  std::size_t indexOf(const std::string& column) const;
  void checkHeader() const;
  void add(Line line);

  std::string source_;
  Line header_{0, {}};
  std::vector<Line> rows_;
};

}  // namespace sightline::config
