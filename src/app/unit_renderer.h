// Renders units of a picture that processes share, one after the other in one session, each to a
// film file.
#pragma once

#include "app/picture.h"

namespace onde::app {

class UnitRenderer {
  public:
    /// The session, whose options are those of the whole, and the others outlive it. Throws
    /// InputError for an integrator whose samples are not each of one pixel.
    UnitRenderer(Session& session, const RenderRequest& request, const StopOnInterrupt& interrupt);

    const FilmHeader& header() const { return header_; }

    /// As Worker::Render.
    bool render(const Rectangle& window, std::pair<uint32_t, uint32_t> samples,
                const std::filesystem::path& file, const std::function<void()>& renew);

  private:
    Session& session_;
    const RenderRequest& request_;
    const StopOnInterrupt& interrupt_;
    RenderOptions picture_;
    FilmHeader header_;
};

} // namespace onde::app
