#include "core/stack.h"

#include <pthread.h>
#include <sys/resource.h>

namespace onde {

static constexpr size_t ENOUGH = size_t(8) << 20;

void with_enough_stack(const std::function<void()>& work) {
    rlimit limit{};
    pthread_attr_t attributes;
    pthread_t thread{};
    const auto call = [](void* called) -> void* {
        (*static_cast<const std::function<void()>*>(called))();
        return nullptr;
    };
    if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= ENOUGH ||
        pthread_attr_init(&attributes) != 0)
        return work();
    pthread_attr_setstacksize(&attributes, ENOUGH);
    pthread_setattr_default_np(&attributes);
    void* called = const_cast<std::function<void()>*>(&work);
    const bool runs = pthread_create(&thread, &attributes, call, called) == 0;
    pthread_attr_destroy(&attributes);
    if (runs)
        pthread_join(thread, nullptr);
    else
        work(); // with what there is
}

} // namespace onde
