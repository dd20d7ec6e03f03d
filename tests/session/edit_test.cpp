// The picture after an edit is the one of a new session with the edited scene, bit for bit.
#include "core/error.h"
#include "session/small_session.h"

namespace onde::test {
namespace {

/// Renders, edits and renders again; returns the session for more questions.
template <class Edit>
void check_edit(const SessionOptions& options, const Edit& edit) {
    Session session(programs(), varied_scene(), options);
    const std::vector<float> before = rendered(session);
    edit(session);
    const std::vector<float> after = rendered(session);
    CHECK(after != before);
    SessionOptions edited = options;
    edited.render = session.options();
    CHECK(after == fresh_picture(session.scene(), edited));
}

Camera from_above(const Session& session) {
    Camera camera = session.camera();
    camera.camera_to_world =
        glm::inverse(glm::lookAt(glm::vec3(0.5f, 8, 1), glm::vec3(0), glm::vec3(0, 0, -1)));
    return camera;
}

} // namespace

TEST_CASE("another camera makes the picture of a new session, by every integrator") {
    for (const IntegratorKind integrator : ALL_INTEGRATORS) {
        INFO(word_of(integrator));
        check_edit(small_session(integrator),
                   [](Session& session) { session.set_camera(from_above(session)); });
    }
}

TEST_CASE("another rotation of the environment makes the picture of a new session") {
    for (const IntegratorKind integrator : {IntegratorKind::path, IntegratorKind::light}) {
        INFO(word_of(integrator));
        Scene scene = varied_scene();
        scene.environment.map = Image(2, 1, 3);
        scene.environment.radiance = glm::vec3(1.0f);
        scene.environment.map->pixels = {3, 1, 0, 0, 1, 3};
        Session session(programs(), scene, small_session(integrator));
        const std::vector<float> before = rendered(session);
        session.set_environment_rotation(1.0f);
        const std::vector<float> after = rendered(session);
        CHECK(after != before);
        scene.environment.rotation = 1.0f;
        Session fresh(programs(), scene, small_session(integrator));
        CHECK(after == rendered(fresh));
    }
}

TEST_CASE("another camera builds no program and packs nothing") {
    Session session(programs(), varied_scene(), small_session());
    session.render();
    const size_t built = programs().built();
    const void* const nodes = session.packed().bvh.nodes.data();
    const void* const materials = session.packed().materials.data();
    session.set_camera(from_above(session));
    session.render();
    CHECK(programs().built() == built);
    CHECK(session.packed().bvh.nodes.data() == nodes);
    CHECK(session.packed().materials.data() == materials);
}

TEST_CASE("another material makes the picture of a new session, by every integrator") {
    for (const IntegratorKind integrator : ALL_INTEGRATORS) {
        INFO(word_of(integrator));
        check_edit(small_session(integrator), [](Session& session) {
            Material material = session.scene().materials[RED];
            material.base_color = glm::vec3(0.1f, 0.2f, 0.9f);
            session.set_material(RED, material);
        });
    }
}

TEST_CASE("a material that no longer emits, or begins to, makes the picture of a new session") {
    for (const size_t index : {GLOW, RED}) {
        check_edit(small_session(), [&](Session& session) {
            Material material = session.scene().materials[index];
            material.emission = glm::vec3(index == RED ? 2.0f : 0.0f);
            session.set_material(index, material);
        });
    }
}

TEST_CASE("a material alone leaves the tree in its place") {
    Session session(programs(), varied_scene(), small_session());
    const void* const nodes = session.packed().bvh.nodes.data();
    Material material = session.scene().materials[RED];
    material.base_color = glm::vec3(0.5f);
    session.set_material(RED, material);
    CHECK(session.packed().bvh.nodes.data() == nodes);
}

TEST_CASE("moved instances and shapes make the picture of a new session, by every integrator") {
    for (const IntegratorKind integrator : ALL_INTEGRATORS) {
        INFO(word_of(integrator));
        check_edit(small_session(integrator), [](Session& session) {
            session.set_instance_transform(FIRST_TILE, moved({-0.9f, 0.7f, 0.3f})); // instanced
            session.set_instance_transform(LAMP, moved({0.3f, 3.5f, 0}));           // baked
            session.set_shape_transform(0, moved({0.4f, 1.2f, 0.5f}));
        });
    }
}

TEST_CASE("small moves are fitted, and make the picture of a new session") {
    Session session(programs(), varied_scene(), small_session());
    session.set_instance_transform(FIRST_TILE, moved({-1.1f, 0.5f, 0.1f}));
    CHECK(session.packed().bvh.refitted);
    CHECK(rendered(session) == fresh_picture(session.scene(), small_session()));
}

TEST_CASE("moves that make the tree a bad one build it anew") {
    Scene scene = varied_scene();
    constexpr size_t COUNT = 216;
    const auto place = [](size_t i) {
        return moved(glm::vec3(float(i % 6), float(i / 6 % 6), float(i / 36)) - 2.5f);
    };
    for (size_t i = 0; i < COUNT; ++i)
        scene.shapes.push_back(
            {ShapeKind::torus, RED, 0.3f, glm::scale(place(i), glm::vec3(0.1f))});
    Session session(programs(), scene, small_session());
    for (size_t i = 0; i < COUNT; ++i)
        session.set_shape_transform(1 + i, glm::scale(place(i * 77 % COUNT), glm::vec3(0.1f)));
    CHECK_FALSE(session.packed().bvh.refitted);
    CHECK(rendered(session) == fresh_picture(session.scene(), small_session()));
}

TEST_CASE("trees of all layouts follow moves") {
    for (const BvhLayout layout : {BvhLayout::wide, BvhLayout::compressed, BvhLayout::binary}) {
        INFO(word_of(layout));
        SessionOptions options = small_session();
        options.bvh.layout = layout;
        options.choose_layout = false;
        check_edit(options, [](Session& session) {
            session.set_instance_transform(SECOND_TILE, moved({0.9f, 0.8f, 0}));
        });
    }
}

TEST_CASE("lights that move and lights that are added get the light tree of a new session") {
    SessionOptions options = small_session();
    options.lights.sampler = LightSampler::tree;
    check_edit(options, [](Session& session) {
        session.set_instance_transform(LAMP, moved({0.3f, 3.5f, 0}));
    });
    check_edit(small_session(), [](Session& session) {
        CHECK_FALSE(session.packed().features.light_tree);
        Material glowing = session.scene().materials[RED];
        glowing.emission = glm::vec3(0.5f);
        session.set_material(RED, glowing);
        CHECK(session.packed().features.light_tree);
    });
}

TEST_CASE("other options make the picture of a new session") {
    check_edit(small_session(), [](Session& session) {
        RenderOptions options = session.options();
        options.width = 24;
        options.seed = 7;
        options.integrator = IntegratorKind::whitted;
        session.set_options(options);
    });
}

TEST_CASE("an edit that cannot be leaves the session as it was") {
    Session session(programs(), varied_scene(), small_session());
    const std::vector<float> before = rendered(session);
    Material material;
    material.roughness = 2.0f;
    CHECK_THROWS_AS(session.set_material(RED, material), InputError);
    CHECK_THROWS_WITH(session.set_material(17, Material{}), Catch::Contains("no material 17"));
    CHECK_THROWS_AS(session.set_instance_transform(LAMP, glm::mat4(0.0f)), InputError);
    CHECK_THROWS_AS(session.set_shape_transform(1, glm::mat4(1.0f)), InputError);
    Camera camera = session.camera();
    camera.vertical_fov = -1.0f;
    CHECK_THROWS_AS(session.set_camera(camera), InputError);
    RenderOptions options = session.options();
    options.camera = 5;
    CHECK_THROWS_WITH(session.set_options(options), Catch::Contains("no camera 5"));
    options = session.options();
    options.settings.chunk = 3;
    CHECK_THROWS_AS(session.set_options(options), InputError);
    CHECK(session.picture().pixels == before);
    CHECK(scene_hash(session.scene()) == scene_hash(varied_scene()));
}

} // namespace onde::test
