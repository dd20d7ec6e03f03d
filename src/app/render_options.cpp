// The options of `onde render` and of commands that take some of them.
#include "app/render_request.h"

#include "app/sequence.h"
#include "scene/load.h"

#include <map>

#include <fmt/format.h>

namespace onde::app {
namespace {

const std::map<std::string, bool> SWITCH{{"on", true}, {"off", false}};

void declare_view(Command& command, RenderRequest& r) {
    command.option("scene", &r.scene, fmt::format("Scene: {}", SCENE_FILES),
                   {.value = "SCENE", .required = true});
    command.option("--size", &r.size, "Pixels, for example 640x480 (the scene's, else 800x600)",
                   {.value = "WxH"});
    command.option("--camera", &r.choices.camera,
                   "Camera of the scene, by name or number (the first)");
    command.choice("--projection", r.projection,
                   "How the camera maps directions to the picture: the whole sphere as a panorama, "
                   "a circle of\n180 degrees as a fisheye (the camera's own)");
    command.option("--shutter", &r.shutter,
                   "Blur what moves: frames for which the shutter is open from the frame's moment "
                   "on; 0.5\nis a shutter of 180 degrees (the scene's seconds, else 0)",
                   {.value = "FRAMES"});
    command.option(
        "--fps", &r.frames_a_second,
        "Frames a second of --frames, of --shutter, and of the next frame to which --aov "
        "motion leads\n(24)",
        {.value = "N"});
    declare_light(command, r);
}

void declare_picture(Command& command, RenderRequest& r) {
    command.option("-o,--output", &r.outputs,
                   "Picture to write, .png or .exr, or - for a PNG to standard output;\n"
                   "may be given several times (SCENE.png in the current folder)",
                   {.value = "FILE"});
    command.option("--spp", &r.choices.samples, "Samples per pixel (the scene's, else 64)",
                   {.value = "N"});
    command.option("--time", &r.choices.seconds, "Stop a picture after about that many seconds",
                   {.value = "SECONDS"});
    command.option("--noise", &r.choices.noise,
                   "Render until each pixel is, with 95 % probability, off by no more than this\n"
                   "share of white as it is shown, for example 0.02; --spp is the most then (off)",
                   {.value = "ERROR"});
    command.option(
        "--aov", &r.aovs,
        "Further channels: in an .exr beside the picture's own, to OUTPUT.WORD.png of a\n"
        ".png; docs/scene-format.md says what each holds (the scene's)",
        {.value = "WORD", .delimiter = ',', .words = aov_words()});
    command.option(
        "--clamp", &r.choices.clamp,
        "The most radiance of a sample: fewer specks, less light; says how much less (the "
        "scene's, else any)",
        {.value = "RADIANCE"});
    declare_denoiser(command, r);
    declare_display(command, r);
    command.choice(
        "--exr-names", r.exr_names,
        "How the channels of an .exr are called: albedo.R, or as Blender has it (plain)");
    command.flag("--float", r.full_float, "Write 32-bit .exr instead of 16-bit");
}

void declare_film(Command& command, RenderRequest& r) {
    command.option("--film", &r.film,
                   "Film file to write, .exr of 32 bits, to go on from or to join with others; at\n"
                   "the end and when interrupted. Without -o there is no picture then",
                   {.value = "FILE"});
    command.option("--checkpoint", &r.checkpoint,
                   "Write the film every so many seconds too, while the picture goes on",
                   {.value = "SECONDS"});
    command.option("--resume", &r.resume,
                   "Go on from this film file; without --film that one is written again",
                   {.value = "FILE"});
    command.option("--samples", &r.sample_range,
                   "Only samples A to B - 1 of the picture's --spp; multiples of 64, or its last",
                   {.value = "A:B"});
    command.option("--rectangle", &r.rectangle,
                   "Only the pixels of this rectangle; the others stay black",
                   {.value = "X,Y,W,H"});
}

void declare_estimator(Command& command, RenderRequest& r) {
    command.choice("--integrator", r.choices.integrator,
                   "What is computed (the scene's, else path)");
    command.option("--depth", &r.choices.depth,
                   "The most surfaces a path visits (the scene's, else 12; 8 of ray trees)",
                   {.value = "N"});
    command.option("--seed", &r.choices.seed, "Of the random numbers; same seed, same picture (0)",
                   {.value = "N"});
    command.choice("--filter", r.choices.filter, "Pixel filter (blackman-harris)");
    command.choice(
        "--light-sampler", r.light_sampler,
        "How a path chooses one of many lights: by its power, or by what it may send to "
        "the\npoint that is lit, down a tree of bounds (the scene's, else auto: the tree for many "
        "lights)");
    command.choice("--bvh", r.bvh.builder,
                   "Tree of boxes: fast to build (sah), fast to traverse (high), or a plain one to "
                   "compare with");
    command.choice("--layout", r.layout,
                   "How the tree lies in memory (wide on CPUs, measured once on others)");
    command.flag("--watertight", r.bvh.watertight,
                 "Let no ray slip between triangles that share an edge or a corner");
}

void declare_engine(Command& command, RenderRequest& r) {
    command.choice("--engine", r.choices.engine,
                   "How paths are driven through the device (wavefront)");
    command.choice("--launch", r.choices.launch,
                   "Wavefront stages one by one, or all in one kernel (what suits the device)");
    command.choice("--interleave", r.choices.interleave, SWITCH,
                   "Rays of late bounces interleaved (where the BVH is larger than the cache)");
    command.option("--lanes", &r.choices.lanes, "Paths shaded at once by a work item: 1, 8 or 16",
                   {.value = "N"});
    command.option("--wave-size", &r.choices.wave_size, "Paths in flight", {.value = "N"});
    command.option("--chunk", &r.choices.chunk, "Paths of one work item", {.value = "N"});
}

void declare_sequence(Command& command, RenderRequest& r) {
    command.option("--turntable", &r.turntable,
                   "Render N pictures of the camera around the vertical axis of the scene,\n"
                   "OUTPUT.0001.png and on; # signs in OUTPUT stand for the digits",
                   {.value = "N", .least = 1, .most = MOST_PICTURES});
    command.option("--frames", &r.frames,
                   "Render these frames of the scene's animation, OUTPUT.0000.png and on",
                   {.value = "FIRST:LAST"});
}

void declare_reports(Command& command, RenderRequest& r) {
    command.flag("--stats", r.stats, "Print times, rays, memory and kernel times");
    command.option("--json", &r.json,
                   "Write the same numbers to this file, or - for standard output",
                   {.value = "FILE"});
    command.flag("--quiet", r.quiet, "Print warnings and errors only");
}

} // namespace

void declare_light(Command& command, RenderRequest& r) {
    command.option("--environment", &r.environment,
                   "Light the scene with this equirectangular picture (.hdr, .exr)",
                   {.value = "FILE"});
    command.option("--environment-rotation", &r.environment_rotation,
                   "Turn that picture, counter-clockwise seen from above", {.value = "DEGREES"});
    command.choice("--studio", r.studio,
                   "Light of soft boxes for files without an environment (for models and what is "
                   "dark else)");
    command.choice(
        "--ground", r.ground,
        "A plane under the scene that shows only its shadow and reflection (for models)");
}

void declare_display(Command& command, RenderRequest& r) {
    command.option("--exposure", &r.exposure, "Brighten the .png by that many stops",
                   {.value = "STOPS"});
    command.choice("--tone-map", r.tone_map,
                   "How bright light is shown in the .png (the scene's, else neutral; none for the "
                   "chapter's integrators)");
    command.choice("--background", r.choices.background,
                   "What is behind the scene; transparent gives the picture an alpha channel, "
                   "multiplied in .exr, straight in .png (environment)");
}

void declare_denoiser(Command& command, RenderRequest& r) {
    command.choice_or_alone(
        "--denoise", r.denoise, Denoiser::automatic,
        "Take the noise from the picture: by Open Image Denoise where its "
        "library is found,\nelse our own denoiser; alone it means auto (the scene's, "
        "else off)");
    command.option("--denoiser-library", &r.denoiser.oidn,
                   "libOpenImageDenoise.so.2, or a folder that has it (that of Python's pyoidn, or "
                   "the system's)",
                   {.value = "PATH"});
    command.choice("--denoise-quality", r.denoiser.quality,
                   "What guides Open Image Denoise is denoised first, which takes 7 times as long, "
                   "or is not (high)");
}

void declare_machine(Command& command, MachineRequest& r) {
    command.option(
        "--device", &r.device,
        "Device by number or part of its name (see onde devices); to render by several:\n"
        "all, or a list such as 0,2; 0/2 is device 0 in two parts");
    command.option("--kernels", &r.kernels, "Read kernels from this folder (live editing)",
                   {.value = "DIR"});
    command.flag("--no-cache", r.no_cache, "Compile kernels anew");
}

void declare_options(Command& command, RenderRequest& request) {
    declare_view(command, request);
    declare_load(command, request.load);
    declare_picture(command, request);
    declare_sequence(command, request);
    declare_film(command, request);
    declare_estimator(command, request);
    declare_engine(command, request);
    declare_machine(command, request.machine);
    command.flag("--mixed-devices", request.mixed_devices,
                 "Let devices of several classes share a picture: its bits then depend on which of "
                 "them took what");
    declare_reports(command, request);
}

void declare_mpi(Command& command, RenderRequest& r) {
    command.flag("--mpi", r.mpi,
                 "Render with the other ranks of the job that mpirun started: mpirun -n 8 onde "
                 "render --mpi ...");
    command.option("--parts", &r.parts,
                   "Folder that all ranks see, from which a job that died goes on (OUTPUT.parts)",
                   {.value = "DIR"});
}

void declare_replay_options(Command& command, RenderRequest& request) {
    declare_view(command, request);
    declare_load(command, request.load);
    declare_estimator(command, request);
    declare_machine(command, request.machine);
}

} // namespace onde::app
