// What a killed process leaves on disk: known by a lock that ends with its process, whatever the
// process numbers of other containers and machines are.
#pragma once

#include <filesystem>
#include <string_view>

namespace onde {

/// An open file descriptor, closed with its scope.
class Descriptor {
  public:
    explicit Descriptor(int number = -1) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
    Descriptor& operator=(Descriptor&& other) noexcept;

    int get() const { return number_; }
    explicit operator bool() const { return number_ >= 0; }
    void close();
    int release();

  private:
    int number_;
};

/// Marks what is open there as in use until it is closed or the process ends. False when it was
/// removed meanwhile, by another process that took it for abandoned.
bool hold(const Descriptor& open);

/// The same of what another process may have marked: then false, at once. File systems without
/// locks know of no other.
bool try_hold(const Descriptor& open);

/// Removes the files and folders in `folder` that are this user's, have a name that starts with
/// `prefix` and that nobody holds. Never throws.
void remove_abandoned(const std::filesystem::path& folder, std::string_view prefix) noexcept;

} // namespace onde
