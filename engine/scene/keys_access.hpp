#pragma once

#include "engine/scene/keys.hpp"

#include <type_traits>

// How a row of the table of keys names its member: reach<&Scene::cortex, &Cortex::elastic,
// &Elastic::E_kPa>() follows the members from the scene (or from the draft), through optional parts
// and into the item of a list that is being read. For keys.cpp only.
namespace spheroscope::scene {

template <class T> struct IsOptional : std::false_type {};
template <class T> struct IsOptional<std::optional<T>> : std::true_type {};
template <class T> struct IsVector : std::false_type {};
template <class T> struct IsVector<std::vector<T>> : std::true_type {};

/// The object behind an optional, made if it is not there yet.
template <class T> auto& behind(T& object) {
    if constexpr (IsOptional<T>::value) {
        if (!object) object.emplace();
        return *object;
    } else {
        return object;
    }
}

template <auto Member, auto... Rest, class Object> auto& follow(Object& object, std::size_t item) {
    auto& member = object.*Member;
    using Type = std::remove_reference_t<decltype(member)>;
    if constexpr (sizeof...(Rest) == 0) {
        return behind(member);
    } else if constexpr (IsVector<Type>::value) {
        return follow<Rest...>(member[item], item);
    } else {
        return follow<Rest...>(behind(member), item);
    }
}

template <class Class, class Type> Class class_of(Type Class::*);

template <auto First, auto... Rest> auto& from_draft(Draft& draft, std::size_t item) {
    if constexpr (std::is_same_v<decltype(class_of(First)), Draft>)
        return follow<First, Rest...>(draft, item);
    else
        return follow<First, Rest...>(draft.scene, item);
}

template <auto... Members> constexpr Access reach() {
    using Type = std::remove_reference_t<decltype(from_draft<Members...>(std::declval<Draft&>(),
                                                                         std::size_t{}))>;
    return Reach<Type>(&from_draft<Members...>);
}

/// The same for a member that is an enumeration; its words are in the order of its values.
template <auto... Members> constexpr Access choose(std::span<const std::string_view> words) {
    using Type = std::remove_reference_t<decltype(from_draft<Members...>(std::declval<Draft&>(),
                                                                         std::size_t{}))>;
    return Choice{words,
                  [](Draft& draft, std::size_t item) {
                      return static_cast<int>(from_draft<Members...>(draft, item));
                  },
                  [](Draft& draft, std::size_t item, int word) {
                      from_draft<Members...>(draft, item) = static_cast<Type>(word);
                  }};
}

/// Makes the part that the members lead to, or the next item of a list, and notes its place.
template <auto... Members> void enter(Draft& draft, const Loc& loc, const std::string& /*name*/) {
    auto& part = from_draft<Members...>(draft, 0);
    if constexpr (IsVector<std::remove_reference_t<decltype(part)>>::value)
        part.emplace_back().loc = loc;
    else
        part.loc = loc;
}

}  // namespace spheroscope::scene
