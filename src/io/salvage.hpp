#pragma once
// Reading on past what is damaged.

#include "delmesh/base/error.hpp"
#include "delmesh/io/read.hpp"

#include <string>

namespace delmesh::io {

/// Tells errors that only cost a part of the file from those that end it, and keeps a list of the former.
class Salvage {
public:
    /// Without a list every error ends the reading.
    explicit Salvage(FileDamage* damage) : damage_(damage) {}

    [[nodiscard]] bool is_wanted() const { return damage_ != nullptr; }
    [[nodiscard]] bool found_damage() const { return damage_ != nullptr && damage_->count > 0; }

    /// Calls; false if that failed and the failure is on the list.
    template <class Call>
    bool attempt(Call&& call) {
        if (damage_ == nullptr) {
            call();
            return true;
        }
        try {
            call();
            return true;
        } catch (const Error& error) {
            if (error.code() != ErrorCode::file_format && error.code() != ErrorCode::index_out_of_range) throw;
            note(error.what());
            return false;
        }
    }

    /// Requires is_wanted().
    void note(const std::string& sentence) {
        if (damage_->count++ < most_sentences) damage_->sentences.push_back(sentence);
    }
    [[nodiscard]] const std::string& first() const { return damage_->sentences.front(); }

private:
    static constexpr std::size_t most_sentences = 16;

    FileDamage* damage_;
};

}  // namespace delmesh::io
