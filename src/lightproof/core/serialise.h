// Values as bytes and back, to the last bit: what one process computes, another one merges. Numbers
// are little-endian, whatever the machine; a text or a list begins with its length.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "lightproof/core/enumeration.h"

namespace lightproof {

/// Appends values to a string of bytes. A type takes part by `void write(ValueWriter&) const`, or
/// by a static `fields(value)`, which ties all that makes it up.
class ValueWriter {
 public:
  template <std::integral Number>
  void add(Number number) {
    const auto value = static_cast<std::uint64_t>(number);
    for (int byte = 0; byte < 8; ++byte) bytes_ += static_cast<char>(value >> (8 * byte) & 0xffU);
  }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::string_view text) {
    add(text.size());
    bytes_ += text;
  }
  template <class Enumeration>
  requires std::is_enum_v<Enumeration>
  void add(Enumeration value) {
    static_assert(kValuesOf<Enumeration> > 0);
    add(static_cast<std::uint64_t>(value));
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(values.size());
    for (const Value& value : values) add(value);
  }
  template <class Value, std::size_t kCount>
  void add(const std::array<Value, kCount>& values) {
    for (const Value& value : values) add(value);
  }
  template <class Key, class Value>
  void add(const std::map<Key, Value>& values) {
    add(values.size());
    for (const auto& [key, value] : values) {
      add(key);
      add(value);
    }
  }
  template <class Value>
  void add(const std::optional<Value>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <class... Values>
  void add(const std::variant<Values...>& value) {
    add(value.index());
    std::visit([this](const auto& chosen) { this->add(chosen); }, value);
  }
  /// Adds a vector of glm, component by component.
  template <class Vector>
  requires requires(const Vector& vector) {
    typename Vector::value_type;
    Vector::length();
    vector[0];
  }
  void add(const Vector& vector) {
    for (int i = 0; i < Vector::length(); ++i) add(vector[i]);
  }
  template <class Grid>
  requires requires(const Grid& grid) { grid.extent().width; }
  void add(const Grid& grid) {
    add(grid.extent().width);
    add(grid.extent().height);
    for (const auto& value : grid.values()) add(value);
  }
  template <class Value>
  requires requires(const Value& value, ValueWriter& writer) { value.write(writer); }
  void add(const Value& value) { value.write(*this); }
  template <class Value>
  requires requires(const Value& value) { Value::fields(value); }
  void add(const Value& value) {
    std::apply([this](const auto&... fields) { (this->add(fields), ...); }, Value::fields(value));
  }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads values from the bytes of a ValueWriter, in the order in which they were added. A type
/// takes part by `static Value read(ValueReader&)`, or by the `fields` of ValueWriter. Throws
/// std::out_of_range where the bytes end too early, or hold a number that is no value of its type.
class ValueReader {
 public:
  explicit ValueReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t number() {
    const std::string_view eight = next(8);
    std::uint64_t value = 0;
    for (int byte = 0; byte < 8; ++byte) {
      value |= std::uint64_t{static_cast<unsigned char>(eight[static_cast<std::size_t>(byte)])}
               << (8 * byte);
    }
    return value;
  }
  double real() { return std::bit_cast<double>(number()); }
  std::string text() { return std::string(next(number())); }

  template <class Value>
  Value value() {
    return read(std::type_identity<Value>());
  }

  bool is_at_end() const { return bytes_.empty(); }

 private:
  template <std::floating_point Number>
  Number read(std::type_identity<Number> /*type*/) {
    return static_cast<Number>(real());
  }
  std::string read(std::type_identity<std::string> /*type*/) { return text(); }
  template <std::integral Number>
  Number read(std::type_identity<Number> /*type*/) {
    const std::uint64_t wide = number();
    const auto narrow = static_cast<Number>(wide);
    require(static_cast<std::uint64_t>(narrow) == wide);
    return narrow;
  }
  template <class Enumeration>
  requires std::is_enum_v<Enumeration> Enumeration read(std::type_identity<Enumeration> /*type*/) {
    const std::uint64_t value = number();
    require(value < kValuesOf<Enumeration>);
    return static_cast<Enumeration>(value);
  }
  template <class Value>
  std::vector<Value> read(std::type_identity<std::vector<Value>> /*type*/) {
    std::vector<Value> values;
    for (std::uint64_t left = number(); left > 0; --left) values.push_back(value<Value>());
    return values;
  }
  template <class Value, std::size_t kCount>
  std::array<Value, kCount> read(std::type_identity<std::array<Value, kCount>> /*type*/) {
    std::array<Value, kCount> values{};
    for (Value& each : values) each = value<Value>();
    return values;
  }
  template <class Key, class Value>
  std::map<Key, Value> read(std::type_identity<std::map<Key, Value>> /*type*/) {
    std::map<Key, Value> values;
    for (std::uint64_t left = number(); left > 0; --left) {
      Key key = value<Key>();
      require(values.emplace(std::move(key), value<Value>()).second);
    }
    return values;
  }
  template <class Value>
  std::optional<Value> read(std::type_identity<std::optional<Value>> /*type*/) {
    if (!value<bool>()) return std::nullopt;
    return value<Value>();
  }
  template <class... Values>
  std::variant<Values...> read(std::type_identity<std::variant<Values...>> /*type*/) {
    std::variant<Values...> chosen;
    const std::uint64_t index = number();
    std::uint64_t alternative = 0;
    const bool found = ((alternative++ == index && (chosen = value<Values>(), true)) || ...);
    require(found);
    return chosen;
  }
  template <class Vector>
  requires requires(const Vector& vector) {
    typename Vector::value_type;
    Vector::length();
    vector[0];
  }
  Vector read(std::type_identity<Vector> /*type*/) {
    Vector vector{};
    for (int i = 0; i < Vector::length(); ++i) vector[i] = value<typename Vector::value_type>();
    return vector;
  }
  template <class Grid>
  requires requires(const Grid& grid) { grid.extent().width; }
  Grid read(std::type_identity<Grid> /*type*/) {
    decltype(Grid().extent()) extent;
    extent.width = value<int>();
    extent.height = value<int>();
    // Every value takes eight bytes at least: a damaged size claims no memory.
    require(extent.width >= 0 && extent.height >= 0 && extent.count() <= bytes_.size() / 8);
    Grid grid(extent);
    for (auto& at : grid.values()) at = value<std::remove_cvref_t<decltype(at)>>();
    return grid;
  }
  template <class Value>
  requires requires(ValueReader& reader) { Value::read(reader); }
  Value read(std::type_identity<Value> /*type*/) { return Value::read(*this); }
  template <class Value>
  requires requires(Value& value) { Value::fields(value); }
  Value read(std::type_identity<Value> /*type*/) {
    Value value{};
    std::apply(
        [this](auto&... fields) {
          ((fields = this->value<std::remove_cvref_t<decltype(fields)>>()), ...);
        },
        Value::fields(value));
    return value;
  }

  std::string_view next(std::uint64_t count) {
    if (count > bytes_.size()) throw std::out_of_range("serialised bytes end too early");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  static void require(bool is_value) {
    if (!is_value) throw std::out_of_range("serialised bytes hold what is no value of its type");
  }

  std::string_view bytes_;
};

}  // namespace lightproof
