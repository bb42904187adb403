// ThreadSanitizer sees how oneTBB orders threads.
//
// Debian's libtbb is not instrumented, so what a thread has written before it spawns a task
// seems to race with the task that reads it on another thread, and what tasks have written with
// whoever waited for them. Suppressing that would suppress every race inside a parallel loop.
// Instead the three calls through which the headers hand tasks to the library are made here first,
// in thread-sanitized builds alone, and the order that the library keeps is told: a task begins
// after its spawn, and a wait ends after the tasks waited for. Memory of tasks comes from the heap,
// whose reuse ThreadSanitizer knows, instead of pools that threads hand to each other.
#include <oneapi/tbb/detail/_small_object_pool.h>
#include <oneapi/tbb/detail/_task.h>
#include <sanitizer/tsan_interface.h>

#include <dlfcn.h>

#include <cstddef>
#include <new>

namespace tbb::detail::r1 {
namespace {

using d1::task;
using d1::task_group_context;
using d1::wait_context;

/// A task that begins another after whatever its spawner did.
class OrderedTask final : public task {
public:
  explicit OrderedTask(task& inner) : inner_(inner) { __tsan_release(this); }
  task* execute(d1::execution_data& data) override {
    task& inner = begin();
    return inner.execute(data);
  }
  task* cancel(d1::execution_data& data) override {
    task& inner = begin();
    return inner.cancel(data);
  }

private:
  task& begin() {
    __tsan_acquire(this);
    task& inner = inner_;
    delete this;
    return inner;
  }
  task& inner_;
};

/// The library's own function of that mangled name.
template <typename Function>
Function* library(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// Tasks that end count down an atomic of the wait context, behind its first eight bytes.
void after_tasks_of(wait_context& wait) { __tsan_acquire(reinterpret_cast<char*>(&wait) + 8); }

} // namespace

void spawn(task& t, task_group_context& context) {
  static const auto next = library<void(task&, task_group_context&)>(
      "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextE");
  next(*new OrderedTask(t), context);
}

void spawn(task& t, task_group_context& context, d1::slot_id slot) {
  static const auto next = library<void(task&, task_group_context&, d1::slot_id)>(
      "_ZN3tbb6detail2r15spawnERNS0_2d14taskERNS2_18task_group_contextEt");
  next(*new OrderedTask(t), context, slot);
}

void execute_and_wait(task& t, task_group_context& context, wait_context& waited,
                      task_group_context& waiting) {
  static const auto next =
      library<void(task&, task_group_context&, wait_context&, task_group_context&)>(
          "_ZN3tbb6detail2r116execute_and_waitERNS0_2d14taskERNS2_18task_group_contextERNS2_12wait_"
          "contextES6_");
  next(*new OrderedTask(t), context, waited, waiting);
  after_tasks_of(waited);
}

void wait(wait_context& waited, task_group_context& context) {
  static const auto next = library<void(wait_context&, task_group_context&)>(
      "_ZN3tbb6detail2r14waitERNS0_2d112wait_contextERNS2_18task_group_contextE");
  next(waited, context);
  after_tasks_of(waited);
}

/// The heap is no pool, but the headers insist on one: its address, which is all they look at.
static d1::small_object_pool* no_pool() {
  alignas(std::max_align_t) static std::byte place[64];
  return reinterpret_cast<d1::small_object_pool*>(place);
}

void* allocate(d1::small_object_pool*& pool, std::size_t bytes, const d1::execution_data&) {
  pool = no_pool();
  return ::operator new(bytes, std::align_val_t(d1::task_alignment));
}

void* allocate(d1::small_object_pool*& pool, std::size_t bytes) {
  pool = no_pool();
  return ::operator new(bytes, std::align_val_t(d1::task_alignment));
}

void deallocate(d1::small_object_pool&, void* object, std::size_t, const d1::execution_data&) {
  ::operator delete(object, std::align_val_t(d1::task_alignment));
}

void deallocate(d1::small_object_pool&, void* object, std::size_t) {
  ::operator delete(object, std::align_val_t(d1::task_alignment));
}

} // namespace tbb::detail::r1
