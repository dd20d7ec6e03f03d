// A scene that is rendered on a device: the one assembly of a render. It packs the scene, plans the
// memory, builds programs and integrator, renders, continues and is edited. It prints nothing:
// what it has to say are notes.
#pragma once

#include "film/film_file.h"
#include "render/memory_plan.h"
#include "render/render_loop.h"
#include "render/sampled_pixels.h"
#include "render/traversal_cost.h"
#include "scene/scene.h"
#include "session/inspect.h"
#include "session/picture_denoiser.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace onde {

struct SessionOptions {
    RenderOptions render{};
    BvhOptions bvh{};
    LightOptions lights{};
    /// Whether bvh.layout is replaced by what suits the device, measured once on all but CPUs.
    bool choose_layout = true;
    /// Programs are built for these instead of for just what the scene has, so that sessions of
    /// several scenes share them; they must cover the scene.
    std::optional<SceneFeatures> features{};
    /// Programs are built for these beside what the scene has, as far as the way in which its data
    /// lies allows, so that sessions of scenes that are not yet known share them.
    std::optional<SceneFeatures> further_features{};
    DenoiserOptions denoiser{}; ///< if not off, render.aovs has denoiser_aovs()
    bool timed = false;         ///< kernel_times() are taken, of a device with gpu::Profiling::on
    /// Told each note as it arises, before what it announces is done.
    std::function<void(const std::string&)> on_note{};
};

/// A sample of a pixel, replayed: a path's bounces, or Whitted's ray tree.
using SampleReport = std::variant<PathReport, TreeReport>;

/// A session's picture without its noise, and what it took.
struct DenoisedImage {
    Image picture;
    std::vector<Image> groups; ///< the light of options().light_groups; it adds up to the picture's
    std::string denoiser;      ///< its name
    double seconds = 0;
};

class Session {
  public:
    /// Packs the scene and puts it on the device. Waves that do not fit the device's memory are
    /// halved, with a note. The programs outlive the session. Throws InputError for a scene or
    /// options that cannot be rendered, DeviceError where memory or device fail.
    Session(gpu::Programs& programs, Scene scene, SessionOptions options);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const gpu::Device& device() const { return programs_.device(); }
    const Scene& scene() const { return scene_; }
    const RenderOptions& options() const { return options_.render; }
    /// Whether a denoiser is asked for.
    bool has_denoiser() const { return denoiser_ != nullptr; }
    const Camera& camera() const { return scene_.cameras.at(options_.render.camera); }
    const PackedScene& packed();
    /// Seconds of the last packing, the tree's build included.
    double pack_seconds() const { return pack_seconds_; }
    /// What was mapped, left out or chosen otherwise than asked, a sentence each.
    const std::vector<std::string>& notes() const { return notes_; }
    /// Every buffer of the session.
    MemoryPlan memory_plan();

    /// Builds the programs and allocates what a render needs, where that is still to be done.
    const gpu::BuildReport& prepare();

    /// Renders until the film has options().samples per pixel or options().seconds have passed,
    /// from where it was left. Calls `keep_going` a few times a second, between waves, and stops
    /// when it returns false.
    RenderOutcome render(const std::function<bool(const Progress&)>& keep_going = {});

    Film& film();
    /// The film's mean radiance so far; before a transparent background with alpha as the fourth
    /// channel, by which the others are multiplied.
    Image picture();
    /// The light of each of options().light_groups; it adds up to the picture's.
    std::vector<Image> light_groups();
    /// The picture without its noise, by the denoiser that the options ask for; alpha stays as it
    /// is. Throws InputError where they ask for none or where the library fails, DeviceError where
    /// the device does.
    DenoisedImage denoised();
    /// Begins anew: an empty film, nothing counted.
    void clear();
    /// The film, to go on with in another session, on any device, in waves of any size.
    KeptFilm keep_film();
    /// What it is of.
    FilmHeader film_header() const;
    /// Goes on from there; rays and findings are counted anew. Throws InputError unless it is a
    /// film of this scene with all settings that change a sample, of the same pixels, from the same
    /// sample on.
    void restore_film(const KeptFilm& kept);
    RayCounts ray_counts();
    /// The share of the film's light that options().clamp has cut off; 0 without.
    double clamped_share();
    /// What is known of the noise, where options().noise asks for some.
    std::optional<NoiseReport> noise();
    /// What there is to say about the picture so far, a sentence each.
    std::vector<std::string> findings();
    /// By kernel, of all launches so far; empty unless the session is timed.
    std::map<std::string, gpu::KernelTime> kernel_times() { return profiler_.totals(); }

    /// Throws InputError for an integrator that follows neither paths nor ray trees, and as
    /// inspect_path() and inspect_whitted() do.
    SampleReport inspect(const PixelSample& at);
    TraversalCost traversal_cost();

    // Edits. The next picture is, bit for bit, the one of a new session with the edited scene and
    // options. The film starts anew, but for more samples or seconds of the same picture. What an
    // edit makes wrong is an InputError, and the session stays as it was.

    void set_options(const RenderOptions& options);
    /// Replaces the camera that is looked through.
    void set_camera(const Camera& camera);
    /// Turns the environment's map: radians, counter-clockwise seen from above.
    void set_environment_rotation(float radians);
    void set_material(size_t material, const Material& value);
    void set_instance_transform(size_t instance, const glm::mat4& object_to_world);
    void set_shape_transform(size_t shape, const glm::mat4& object_to_world);

  private:
    void note(std::string sentence);
    void note_mapping();
    /// That which the options ask for, if any. Throws InputError.
    std::unique_ptr<PictureDenoiser> make_denoiser();
    Image before_background(const Image& radiance);
    void note_waves(uint32_t asked);
    SceneFeatures features_of(const PackedScene& packed) const;
    bool halve_waves();
    /// Halves waves until the render fits beside the scene; throws DeviceError if none do.
    void fit_waves(const PackedScene& scene);
    void changed(SceneChange change);
    /// Brings the device scene up to the edits.
    void update();
    IntegratorContext context();

    gpu::Programs& programs_;
    Scene scene_;
    SessionOptions options_;
    std::vector<std::string> notes_;
    gpu::Profiler profiler_;
    double pack_seconds_ = 0;
    SceneChange change_ = SceneChange::none; ///< that the device scene lacks
    std::unique_ptr<DeviceScene> placed_;
    std::unique_ptr<PictureDenoiser> denoiser_; ///< where the options ask for one
    std::unique_ptr<Integrator> integrator_;    ///< null until it is needed
};

} // namespace onde
