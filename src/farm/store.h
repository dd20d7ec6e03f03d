// A folder through which workers share a picture, on one disk, on a network's or on a mounted
// object store: film files by the node that they hold, and leases on what is being made. Nothing
// depends on locks: a file is put whole by rename, doing a thing twice gives the same bytes, and a
// lease that two workers took at once costs time only.
#pragma once

#include "film/film_file.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace onde {

/// A node of the samples of a tile: a unit of work at level 0, or several joined.
struct StoreKey {
    uint32_t tile = 0, level = 0, index = 0;

    StoreKey sibling() const { return {tile, level, index ^ 1}; }
    StoreKey parent() const { return {tile, level + 1, index / 2}; }
    auto operator<=>(const StoreKey&) const = default;
};

/// "t0003-l01-i00012", and back.
std::string name_of(const StoreKey& key);
std::optional<StoreKey> key_of(const std::string& name);

class Store {
  public:
    /// Makes the folder where there is none. Leases expire after so many seconds by the store's own
    /// clock, so that no clocks of workers need agree. Throws InputError.
    Store(const std::filesystem::path& folder, double lease_seconds);

    /// What is there, but for what a joined node holds too.
    std::vector<StoreKey> list() const;
    std::filesystem::path path(const StoreKey& key) const;
    std::filesystem::path film() const { return folder_ / "film.exr"; }
    void remove(const StoreKey& key) const;
    /// Undoes the making of a folder to which nothing has been put.
    void remove_if_unused() const;
    /// The store itself, with all that it has; what else lies in the folder stays, and it too then.
    void remove_all() const;

    /// Takes the lease of that name; false while another worker has it.
    bool claim(const std::string& name) const;
    /// To be called now and then, so that it does not expire.
    void renew(const std::string& name) const;
    void release(const std::string& name) const;

    /// The leases that are held now.
    uint32_t count_leases() const;
    /// Of the names in notes, those that end so.
    std::vector<std::string> notes(const std::string& end) const;

    /// A small text by name, such as a hash; whole or not there.
    void put(const std::string& name, const std::string& text) const;
    std::optional<std::string> get(const std::string& name) const;

  private:
    std::filesystem::path lease(const std::string& name) const;
    bool has_expired(const std::filesystem::path& lease) const;

    std::filesystem::path folder_;
    double lease_seconds_;
    bool is_made_; ///< the folder was not there before
};

} // namespace onde
