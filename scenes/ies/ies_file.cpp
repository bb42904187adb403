#include "scenes/ies/ies_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace meninas {

namespace {

constexpr double max_angles = 10'000.0, max_values = 4e6, brightest = 1e12;

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v' || c == ',' || c == '\x1a' || c == '\0';
}

/// Lines, and the numbers in them, wherever lines end.
class Reader {
public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::size_t line() const { return line_; }
  bool at_end() const { return place_ >= text_.size(); }

  /// The rest of this line, without blanks at its ends.
  std::string_view rest_of_line() {
    const std::size_t begin = std::min(place_, text_.size());
    const std::size_t end = std::min(text_.find('\n', begin), text_.size());
    place_ = std::min(end + 1, text_.size());
    if (place_ > end)
      ++line_;
    std::string_view line = text_.substr(begin, end - begin);
    while (!line.empty() && is_blank(line.front()))
      line.remove_prefix(1);
    while (!line.empty() && is_blank(line.back()))
      line.remove_suffix(1);
    return line;
  }

  /// The next word of this or a later line; empty at the end.
  std::string_view word() {
    while (place_ < text_.size() && (is_blank(text_[place_]) || text_[place_] == '\n'))
      line_ += text_[place_++] == '\n' ? 1 : 0;
    const std::size_t begin = place_;
    while (place_ < text_.size() && !is_blank(text_[place_]) && text_[place_] != '\n')
      ++place_;
    return text_.substr(begin, place_ - begin);
  }

  double number(const std::string& name) {
    std::string_view field = word();
    if (field.empty())
      fail(fmt::format("the file ends before {}", name));
    if (field.starts_with('+'))
      field.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
      fail(fmt::format("{} is no number", name));
    return value;
  }

  /// A number that counts, at least 1.
  std::size_t count(const std::string& name) {
    const double value = number(name);
    if (!(value >= 1.0 && value <= max_angles && value == std::floor(value)))
      fail(fmt::format("{} is {:g}, not from 1 to {:g}", name, value, max_angles));
    return static_cast<std::size_t>(value);
  }

  double not_negative(const std::string& name) {
    const double value = number(name);
    if (!(value >= 0.0 && value <= brightest))
      fail(fmt::format("{} is {:g}, not from 0 to {:g}", name, value, brightest));
    return value;
  }

  [[noreturn]] void fail(const std::string& what) const { throw IesProblem(line_, what); }

private:
  std::string_view text_;
  std::size_t place_ = 0, line_ = 1;
};

enum class Edition { before_1995, since_1995 };

Edition edition_of(std::string_view first_line) {
  for (const char* later : {"IESNA:LM-63-1995", "IESNA:LM-63-2002", "IES:LM-63-2019"})
    if (first_line.starts_with(later))
      return Edition::since_1995;
  return Edition::before_1995;
}

/// Up to and with the line TILT=NONE; files of 1986 begin with keywords, or with labels.
Edition read_head(Reader& reader) {
  Edition edition = Edition::before_1995;
  for (bool first = true; !reader.at_end(); first = false) {
    const std::size_t number = reader.line();
    std::string_view line = reader.rest_of_line();
    if (first) {
      if (line.starts_with("\xef\xbb\xbf"))
        line.remove_prefix(3);
      edition = edition_of(line);
    }
    if (!line.starts_with("TILT"))
      continue;
    std::string tilt;
    std::ranges::copy_if(line.substr(4), std::back_inserter(tilt), [](char c) { return !is_blank(c); });
    if (tilt == "=NONE")
      return edition;
    if (tilt.starts_with('='))
      throw IesProblem(number, "its TILT is not NONE: what lamps lose when tilted is not read");
  }
  reader.fail("no line says TILT=NONE: not an IES file");
}

struct Head {
  double factor = 1.0;
  std::size_t vertical = 0, horizontal = 0;
  Photometry photometry = Photometry::type_c;
};

Photometry photometry_of(Reader& reader) {
  const double type = reader.number("the photometric type");
  if (type == 1.0)
    return Photometry::type_c;
  if (type == 2.0)
    return Photometry::type_b;
  reader.fail(type == 3.0 ? "its photometry is of type A, of headlamps: only types C and B are read"
                          : fmt::format("photometric type {:g} does not exist", type));
}

Head read_numbers(Reader& reader, Edition edition) {
  Head head;
  reader.number("the number of lamps");
  reader.number("the lumens of a lamp");
  head.factor = reader.not_negative("the candela multiplier");
  head.vertical = reader.count("the number of vertical angles");
  head.horizontal = reader.count("the number of horizontal angles");
  if (double(head.vertical) * double(head.horizontal) > max_values)
    reader.fail(fmt::format("{} x {} angles are too many", head.vertical, head.horizontal));
  head.photometry = photometry_of(reader);
  for (const char* unused : {"the unit of lengths", "the width", "the length", "the height"})
    reader.number(unused);
  head.factor *= reader.not_negative("the ballast factor");
  const double photometric = reader.not_negative("the ballast-lamp photometric factor");
  if (edition == Edition::before_1995)
    head.factor *= photometric;
  reader.number("the watts");
  return head;
}

std::vector<double> read_angles(Reader& reader, std::size_t count, const char* kind) {
  std::vector<double> angles;
  for (std::size_t k = 0; k < count; ++k) {
    angles.push_back(reader.number(fmt::format("{} angle {}", kind, k + 1)));
    if (k > 0 && !(angles[k] > angles[k - 1]))
      reader.fail(fmt::format("{} angle {} is {:g}, not over the one before, {:g}", kind, k + 1,
                              angles[k], angles[k - 1]));
  }
  return angles;
}

void check_vertical(const Reader& reader, Photometry photometry, const std::vector<double>& angles) {
  const bool type_c = photometry == Photometry::type_c;
  if (angles.front() < (type_c ? 0.0 : -90.0) || angles.back() > (type_c ? 180.0 : 90.0))
    reader.fail(fmt::format("vertical angles from {:g} to {:g} are not within {} degrees",
                            angles.front(), angles.back(), type_c ? "0 to 180" : "-90 to 90"));
}

void check_horizontal(const Reader& reader, Photometry photometry,
                      const std::vector<double>& angles) {
  if (angles.size() == 1)
    return;
  const double first = angles.front(), last = angles.back();
  const bool type_c = photometry == Photometry::type_c;
  const bool fits = type_c ? (first == 0.0 && (last == 90.0 || last == 180.0 || last == 360.0)) ||
                                 (first == 90.0 && last == 270.0)
                           : (first == 0.0 || first == -last) && last > 0.0 && last <= 90.0;
  if (!fits)
    reader.fail(fmt::format("horizontal angles from {:g} to {:g} are not those of type {}", first,
                            last, type_c ? "C: 0 to 90, 180 or 360, or 90 to 270"
                                         : "B: 0 to 90, or -90 to 90"));
}

} // namespace

IntensityDistribution parse_ies(std::string_view text) {
  Reader reader(text);
  const Edition edition = read_head(reader);
  const Head head = read_numbers(reader, edition);
  IntensityDistribution distribution{.photometry = head.photometry};
  distribution.vertical = read_angles(reader, head.vertical, "vertical");
  check_vertical(reader, head.photometry, distribution.vertical);
  distribution.horizontal = read_angles(reader, head.horizontal, "horizontal");
  check_horizontal(reader, head.photometry, distribution.horizontal);
  const std::size_t values = head.vertical * head.horizontal;
  for (std::size_t k = 0; k < values; ++k) {
    const double value = reader.not_negative(fmt::format("candela value {} of {}", k + 1, values));
    distribution.candela.push_back(head.factor * value);
    if (distribution.candela.back() > brightest)
      reader.fail(fmt::format("{:g} candela are too many", distribution.candela.back()));
  }
  if (!reader.word().empty())
    reader.fail(fmt::format("more than the {} candela values that its angles ask for", values));
  return distribution;
}

} // namespace meninas
