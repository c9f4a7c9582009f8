#include "engine/scene/value_reader.hpp"

#include "engine/base/nearest_word.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace spheroscope::scene {
namespace {

template <class... Ts> struct Overloaded : Ts... { using Ts::operator()...; };
template <class... Ts> Overloaded(Ts...) -> Overloaded<Ts...>;

/// "a number", "an integer"; "one of ..." has none.
std::string with_article(const std::string& noun) {
    if (noun.starts_with("one of ")) return noun;
    const bool vowel = std::string_view("aeiou").find(noun[0]) != std::string_view::npos;
    return (vowel ? "an " : "a ") + noun;
}

/// Reads the numbers, texts and lists of one key; knows the key's name for messages.
class ValueReader {
  public:
    ValueReader(const Document& document, const Key& key, const std::string& path)
        : document_(document), key_(key), path_(path) {}

    void read(const Value& value, double& target) const {
        Quantity quantity;
        switch (value.kind) {
        case Value::Kind::integer: quantity.value = static_cast<double>(value.integer); break;
        case Value::Kind::number: quantity.value = value.number; break;
        case Value::Kind::text: quantity = parse_quantity(value.text, key_.dimension); break;
        default: refuse(value, "");
        }
        if (!quantity.ok()) refuse(value, quantity.problem);
        if (!std::isfinite(quantity.value)) refuse(value, "(not finite)");
        if (const std::string wanted = missed_limits(key_, quantity.value); !wanted.empty())
            refuse_number(value, wanted);
        target = quantity.value;
    }

    void read(const Value& value, int& target) const {
        std::int64_t integer = 0;
        read_integer(value, std::numeric_limits<int>::max(), integer);
        target = static_cast<int>(integer);
    }

    void read(const Value& value, std::uint64_t& target) const {
        std::int64_t integer = 0;
        read_integer(value, std::numeric_limits<std::int64_t>::max(), integer);
        target = static_cast<std::uint64_t>(integer);
    }

    void read(const Value& value, bool& target) const {
        if (value.kind != Value::Kind::boolean) refuse(value, "");
        target = value.boolean;
    }

    void read(const Value& value, std::string& target) const {
        if (value.kind != Value::Kind::text) refuse(value, "");
        if (!key_.words.empty()) static_cast<void>(find_word(value, key_.words));
        // They would reach terminals, pictures and XML, which have no use for them.
        if (std::any_of(value.text.begin(), value.text.end(), [](char letter) {
                return std::iscntrl(static_cast<unsigned char>(letter)) != 0 && letter != '\n';
            }))
            refuse(value, "(with control characters)");
        target = value.text;
    }

    void read(const Value& value, std::vector<std::string>& target) const {
        if (value.kind != Value::Kind::list) refuse(value, "");
        target.clear();
        for (const Value& item : value.items) {
            if (item.kind != Value::Kind::text) refuse(item, "");
            target.push_back(item.text);
        }
    }

    void read(const Value& value, CentreRows& target) const {
        if (value.kind != Value::Kind::list) refuse(value, "");
        target.clear();
        for (const Value& row : value.items) read(row, target.emplace_back());
    }

    template <class T, std::size_t N>
    void read(const Value& value, std::array<T, N>& target) const {
        if (value.kind != Value::Kind::list) refuse(value, "");
        if (value.items.size() != N) refuse(value, fmt::format("({} of them)", value.items.size()));
        for (std::size_t k = 0; k < N; ++k) read(value.items[k], target[k]);
    }

    [[nodiscard]] int find_word(const Value& value, std::span<const std::string_view> words) const {
        if (value.kind != Value::Kind::text) refuse(value, "");
        for (std::size_t k = 0; k < words.size(); ++k)
            if (words[k] == value.text) return static_cast<int>(k);
        const std::vector<std::string> candidates(words.begin(), words.end());
        const std::string nearest = nearest_word(value.text, candidates);
        const std::string note =
            nearest.empty() ? "" : fmt::format("did you mean \"{}\"?", nearest);
        throw Error(value.loc, fmt::format("{} wants {}, got {}{}", path_, describe_type(key_),
                                           document_.as_written(value),
                                           document_.quote(value.loc, value.end_column, note)));
    }

  private:
    void read_integer(const Value& value, std::int64_t largest, std::int64_t& target) const {
        if (value.kind != Value::Kind::integer) refuse(value, "");
        check_bound(value, static_cast<double>(value.integer));
        if (value.integer < -largest || value.integer > largest)
            refuse(value, fmt::format("(beyond {})", largest));
        target = value.integer;
    }

    void check_bound(const Value& value, double number) const {
        if (key_.bound.holds != nullptr && !key_.bound.holds(number))
            refuse_number(value, key_.bound.words);
    }

    [[noreturn]] void refuse_number(const Value& value, std::string_view wanted) const {
        throw Error(value.loc, fmt::format("{} must be {}, got {}{}", path_, wanted,
                                           document_.as_written(value),
                                           document_.quote(value.loc, value.end_column, note())));
    }

    [[noreturn]] void refuse(const Value& value, const std::string& got) const {
        throw Error(value.loc, fmt::format("{} wants {}, got {}{}{}{}", path_,
                                           with_article(describe_type(key_)),
                                           document_.as_written(value), got.empty() ? "" : " ", got,
                                           document_.quote(value.loc, value.end_column, note())));
    }

    [[nodiscard]] std::string note() const {
        if (key_.typical.empty()) return "";
        if (key_.source.empty()) return fmt::format("typical: {}", key_.typical);
        return fmt::format("typical: {} ({})", key_.typical, key_.source);
    }

    const Document& document_;
    const Key& key_;
    const std::string& path_;
};

std::string quoted_list(std::span<const std::string_view> words) {
    std::string text;
    for (const std::string_view word : words)
        text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", word);
    return text;
}

}  // namespace

std::string describe_type(const Key& key) {
    const std::string_view unit = engine_unit(key.dimension);
    std::string quantity = fmt::format("{}{}", dimension_name(key.dimension),
                                       unit.empty() ? "" : fmt::format(" ({})", unit));
    return std::visit(
        Overloaded{
            [&](Reach<double>) { return quantity; },
            [&](Reach<int>) { return std::string("integer"); },
            [&](Reach<std::uint64_t>) { return std::string("integer"); },
            [&](Reach<bool>) { return std::string("true or false"); },
            [&](Reach<std::string>) {
                return key.words.empty() ? std::string("text") : "one of " + quoted_list(key.words);
            },
            [&](Reach<std::vector<std::string>>) { return std::string("list of texts"); },
            [&](Reach<CentreRows>) { return "list of rows of four: " + quantity; },
            [&](Reach<std::array<double, 3>>) { return "list of three: " + quantity; },
            [&](Reach<std::array<double, 2>>) { return "list of two: " + quantity; },
            [&](Reach<std::array<int, 2>>) { return std::string("list of two integers"); },
            [&](const Choice& choice) { return "one of " + quoted_list(choice.words); },
        },
        key.access);
}

std::string missed_limits(const Key& key, double number) {
    if (key.bound.holds != nullptr && !key.bound.holds(number)) return std::string(key.bound.words);
    return missed_sizes(key, number);
}

std::string missed_sizes(const Key& key, double number) {
    const auto may_be = [&](double x) { return key.bound.holds == nullptr || key.bound.holds(x); };
    const auto [smallest, largest] = size_limits(key.dimension);
    const bool may_be_zero = may_be(0.0);
    const double size = std::abs(number);
    if (size <= largest && (may_be_zero || size >= smallest)) return "";
    const double low = !may_be_zero ? smallest : may_be(-largest) ? -largest : 0.0;
    const std::string_view unit = engine_unit(key.dimension);
    return fmt::format("{:g} ... {:g}{}{}", low, largest, unit.empty() ? "" : " ", unit);
}

void read_value(Draft& draft, const Key& key, const Value& value, const std::string& path,
                std::size_t item) {
    const ValueReader reader(*draft.document, key, path);
    std::visit(Overloaded{
                   [&](const Choice& choice) {
                       choice.set(draft, item, reader.find_word(value, choice.words));
                   },
                   [&](auto reach) { reader.read(value, reach(draft, item)); },
               },
               key.access);
}

}  // namespace spheroscope::scene
