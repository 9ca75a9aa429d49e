// One table of a case file: typed, range-checked access that names the key in every complaint.
#pragma once

#include <Eigen/Core>
#include <toml++/toml.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

namespace pelvireg::anatomy
{
/// Allowed values of a number: open or closed ends.
struct Range
{
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool low_open = false;
};
inline constexpr Range any_number{-1e6, 1e6, false};
inline constexpr Range positive{0, 1e6, true};
inline constexpr Range not_negative{0, 1e6, false};

/// Every get marks its key as known; finish() refuses the keys that nobody asked for. All throw InputError.
class TableReader
{
public:
  TableReader(const toml::table &table, std::string path, std::string file);

  bool has(const std::string &key) const { return table_->contains(key); }
  double number(const std::string &key, Range range);
  int integer(const std::string &key, int low, int high);
  std::string text(const std::string &key);
  /// `otherwise` when the key is absent.
  bool flag(const std::string &key, bool otherwise);
  std::vector<double> numbers(const std::string &key, Range range, std::size_t least, std::size_t most = 100);
  std::vector<int> integers(const std::string &key, int low, int high, std::size_t size);
  Eigen::Vector3d point(const std::string &key, Range range = any_number);
  std::vector<Eigen::Vector3d> points(const std::string &key, std::size_t least);
  /// Ascending fractions from 0 to 1, one for each of `size` values of `values_key`.
  std::vector<double> stations(const std::string &key, std::size_t size, const std::string &values_key);
  TableReader table(const std::string &key);
  std::vector<TableReader> tables(const std::string &key);
  std::vector<std::string> keys() const;

  /// Throws InputError for a key that nobody asked for.
  void finish() const;
  /// Throws InputError: "<file>: <path.key> <problem>".
  [[noreturn]] void fail(const std::string &key, const std::string &problem) const;

private:
  const toml::node &node(const std::string &key);
  double checked(const toml::node &value, const std::string &key, Range range) const;
  std::string full(const std::string &key) const { return path_.empty() ? key : path_ + "." + key; }

  const toml::table *table_;
  std::string path_, file_;
  std::set<std::string> known_;
};
} // namespace pelvireg::anatomy
