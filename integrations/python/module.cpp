// The Python module: meninas.h with arrays in place of spans. What a user sees of it is in meninas/__init__.py.
//
// Arrays show the memory of their objects, and keep these alive. Long calls run on a thread of their own: the calling
// thread holds Python's lock only while it hands on progress and asks for signals, so Ctrl-C ends them.
#include <meninas/meninas.h>

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

namespace py = pybind11;
using namespace meninas;

namespace {

/// What a call has to say until somebody listens: of progress the newest.
struct Heard {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::string> warnings;
  std::string stage;
  double done = 0.0;
  bool has_progress = false, ended = false;
  std::atomic<bool> is_cancelled{false};

  Listener listener() {
    if (is_cancelled)
      throw Error(Error::Kind::cancelled, "cancelled");
    return {[this](const std::string& text) {
              const std::lock_guard lock(mutex);
              warnings.push_back(text);
            },
            [this](const std::string& of, double share) {
              const std::lock_guard lock(mutex);
              stage = of;
              done = share;
              has_progress = true;
              return !is_cancelled;
            }};
  }
};

/// The calls that go on. When Python ends they are told to end first: threads that come back from them later would be
/// stopped by Python where C++ may not be left.
class RunningCalls {
public:
  void add(Heard& heard) {
    const std::lock_guard lock(mutex_);
    calls_.insert(&heard);
    heard.is_cancelled = is_over_;
  }
  void remove(Heard& heard) {
    const std::lock_guard lock(mutex_);
    calls_.erase(&heard);
    changed_.notify_all();
  }
  /// Without Python's lock.
  void end() {
    std::unique_lock lock(mutex_);
    is_over_ = true;
    for (Heard* const heard : calls_)
      heard->is_cancelled = true;
    changed_.wait(lock, [&] { return calls_.empty(); });
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<Heard*> calls_;
  bool is_over_ = false;
};
RunningCalls running_calls;

/// Hands on what has been heard. With Python's lock.
void tell(Heard& heard, const py::object& warning, const py::object& progress) {
  std::vector<std::string> warnings;
  std::string stage;
  double done = 0.0;
  bool has_progress = false;
  {
    const std::lock_guard lock(heard.mutex);
    warnings.swap(heard.warnings);
    stage = heard.stage;
    done = heard.done;
    has_progress = std::exchange(heard.has_progress, false);
  }
  for (const std::string& text : warnings)
    if (!warning.is_none())
      warning(text);
  if (has_progress && !progress.is_none())
    if (const py::object answer = progress(stage, done); !answer.is_none() && !answer.cast<bool>())
      heard.is_cancelled = true;
  if (PyErr_CheckSignals() != 0)
    throw py::error_already_set();
}

/// The outcome of `work(listener)`, which runs without Python's lock.
template <typename Work>
auto listened(const py::object& warning, const py::object& progress, const Work& work) {
  constexpr auto a_while = std::chrono::milliseconds(50);
  Heard heard;
  running_calls.add(heard);
  std::optional<decltype(work(std::declval<Listener>()))> result;
  std::exception_ptr failure;
  std::thread worker([&] {
    try {
      result.emplace(work(heard.listener()));
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(heard.mutex);
    heard.ended = true;
    heard.changed.notify_one();
  });
  std::exception_ptr interruption;
  for (bool ended = false; !ended;) {
    {
      const py::gil_scoped_release unlocked;
      std::unique_lock lock(heard.mutex);
      ended = heard.changed.wait_for(lock, a_while, [&] { return heard.ended; });
    }
    if (interruption)
      continue;
    try {
      tell(heard, warning, progress);
    } catch (...) {
      interruption = std::current_exception();
      heard.is_cancelled = true;
    }
  }
  worker.join();
  running_calls.remove(heard);
  if (interruption)
    std::rethrow_exception(interruption);
  if (failure)
    std::rethrow_exception(failure);
  if (heard.is_cancelled) // as the work ended
    throw Error(Error::Kind::cancelled, "cancelled");
  return std::move(*result);
}

/// An array of that shape on memory that `owner` has; not to be written.
template <typename Value>
py::array shown(std::span<const Value> values, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array_t<Value> array(std::move(shape), values.data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

template <typename Owner, typename Value>
py::object rows(const Owner& owner, std::span<const Value> (Owner::*values)() const, py::ssize_t width) {
  const auto span = (owner.*values)();
  const auto count = static_cast<py::ssize_t>(span.size()) / width;
  std::vector<py::ssize_t> shape{count};
  if (width > 1)
    shape.push_back(width);
  return shown(span, shape, py::cast(owner));
}

py::array pixels_of(const RoomPicture& picture, std::span<const float> floats) {
  return shown(floats, {picture.height(), picture.width(), 3}, py::cast(picture));
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

[[noreturn]] void refuse(const std::string& text) { throw Error(Error::Kind::usage, text); }

/// Points and normals, as many of either as three columns.
std::vector<MeasuringPoint> measuring_points(const Numbers& points, const Numbers& normals) {
  for (const auto& [array, name] : {std::pair(points, "points"), std::pair(normals, "normals")})
    if (array.ndim() != 2 || array.shape(1) != 3 || array.shape(0) != points.shape(0))
      refuse(std::string(name) + ": an array of shape (n, 3) is wanted, as long as the points");
  std::vector<MeasuringPoint> result(static_cast<std::size_t>(points.shape(0)));
  for (std::size_t k = 0; k < result.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      result[k].position[c] = points.at(k, c);
      result[k].normal[c] = normals.at(k, c);
    }
  return result;
}

py::dict arriving(const RoomSolution& solution, const Numbers& points, const Numbers& normals, const py::object& progress) {
  const std::vector<MeasuringPoint> at = measuring_points(points, normals);
  const std::vector<Arriving> found = listened(
      py::none(), progress, [&](const Listener& listener) { return solution.irradiance_at(at, listener); });
  const auto count = static_cast<py::ssize_t>(found.size());
  py::array_t<double> total({count, py::ssize_t{3}}), direct({count, py::ssize_t{3}}), mirrored({count, py::ssize_t{3}});
  py::array_t<bool> inside(count);
  for (py::ssize_t k = 0; k < count; ++k) {
    const Arriving& one = found[static_cast<std::size_t>(k)];
    for (std::size_t c = 0; c < 3; ++c) {
      total.mutable_at(k, c) = one.total[c];
      direct.mutable_at(k, c) = one.direct[c];
      mirrored.mutable_at(k, c) = one.by_mirrors[c];
    }
    inside.mutable_at(k) = one.inside;
  }
  return py::dict(py::arg("total") = total, py::arg("direct") = direct, py::arg("by_mirrors") = mirrored,
                  py::arg("inside") = inside);
}

py::dict solved(const RoomFactors& factors, const std::optional<Numbers>& emission, const Settings& settings,
                const py::object& progress) {
  std::span<const double> given;
  if (emission) {
    const auto size = static_cast<py::ssize_t>(factors.size());
    if (emission->ndim() != 2 || emission->shape(0) != size || emission->shape(1) != 3)
      refuse("emission: an array of shape (" + std::to_string(size) + ", 3) is wanted");
    given = {emission->data(), static_cast<std::size_t>(emission->size())};
  }
  const RoomFactors::Solved result = listened(
      py::none(), progress, [&](const Listener& listener) { return factors.solve(given, settings, listener); });
  py::array_t<double> radiosity({static_cast<py::ssize_t>(factors.size()), py::ssize_t{3}}, result.radiosity.data());
  return py::dict(py::arg("radiosity") = radiosity, py::arg("iterations") = result.iterations,
                  py::arg("residual") = result.residual, py::arg("error_bound") = result.error_bound,
                  py::arg("converged") = result.converged);
}

void define_picture(py::module_& module) {
  py::class_<RoomPicture>(module, "Picture")
      .def_static("read", &RoomPicture::read, py::call_guard<py::gil_scoped_release>())
      .def("pixels", [](const RoomPicture& picture) { return pixels_of(picture, picture.pixels()); })
      .def("layer",
           [](const RoomPicture& picture, const std::string& name) { return pixels_of(picture, picture.layer(name)); })
      .def("layers", &RoomPicture::layers)
      .def("stats", &RoomPicture::stats)
      .def("write", &RoomPicture::write, py::call_guard<py::gil_scoped_release>());
  module.def("distance", [](const RoomPicture& picture, const RoomPicture& reference) {
    PictureDistance d;
    {
      const py::gil_scoped_release unlocked;
      d = distance(picture, reference);
    }
    return py::dict(py::arg("rmse") = d.rmse, py::arg("relmse") = d.relmse, py::arg("mae") = d.mae,
                    py::arg("psnr") = d.psnr, py::arg("max_abs") = d.max_abs, py::arg("ssim") = d.ssim,
                    py::arg("flip") = d.flip);
  });
}

void define_solution(py::module_& module) {
  py::class_<RoomSolution>(module, "Solution")
      .def("write", &RoomSolution::write, py::call_guard<py::gil_scoped_release>())
      .def("render",
           [](const RoomSolution& solution, const Settings& settings, const py::object& warning, const py::object& progress) {
             return listened(warning, progress, [&](const Listener& listener) { return solution.render(settings, listener); });
           })
      .def("relit", &RoomSolution::relit, py::call_guard<py::gil_scoped_release>())
      .def("irradiance_at", &arriving)
      .def("vertices", [](const RoomSolution& s) { return rows(s, &RoomSolution::vertices, 3); })
      .def("irradiance", [](const RoomSolution& s) { return rows(s, &RoomSolution::irradiance, 3); })
      .def("elements", [](const RoomSolution& s) { return rows(s, &RoomSolution::elements, 4); })
      .def("node_of_element", [](const RoomSolution& s) { return rows(s, &RoomSolution::node_of_element, 1); })
      .def("area", [](const RoomSolution& s) { return rows(s, &RoomSolution::area, 1); })
      .def("stats", &RoomSolution::stats);
}

void define_factors(py::module_& module) {
  py::class_<RoomFactors>(module, "FormFactors")
      .def("size", &RoomFactors::size)
      .def("channels", &RoomFactors::channels)
      .def("row_begin", [](const RoomFactors& f) { return rows(f, &RoomFactors::row_begin, 1); })
      .def("columns", [](const RoomFactors& f) { return rows(f, &RoomFactors::columns, 1); })
      .def("weights", [](const RoomFactors& f) { return rows(f, &RoomFactors::weights, f.channels()); })
      .def("area", [](const RoomFactors& f) { return rows(f, &RoomFactors::area, 1); })
      .def("centre", [](const RoomFactors& f) { return rows(f, &RoomFactors::centre, 3); })
      .def("normal", [](const RoomFactors& f) { return rows(f, &RoomFactors::normal, 3); })
      .def("reflectance", [](const RoomFactors& f) { return rows(f, &RoomFactors::reflectance, 3); })
      .def("emission", [](const RoomFactors& f) { return rows(f, &RoomFactors::emission, 3); })
      .def("node_of_element", [](const RoomFactors& f) { return rows(f, &RoomFactors::node_of_element, 1); })
      .def("solve", &solved);
}

template <typename Result>
auto call_of_room(Result (Room::*call)(const Settings&, const Listener&) const) {
  return [call](const Room& room, const Settings& settings, const py::object& warning, const py::object& progress) {
    return listened(warning, progress, [&](const Listener& listener) { return (room.*call)(settings, listener); });
  };
}

void define_room(py::module_& module) {
  py::class_<Room>(module, "Room")
      .def(py::init([](const std::filesystem::path& file, const Settings& settings, const py::object& warning) {
        return listened(warning, py::none(), [&](const Listener& listener) { return Room(file, settings, listener); });
      }))
      .def("cameras", &Room::cameras)
      .def("nodes", &Room::nodes)
      .def("lamps", &Room::lamps)
      .def("plan", &Room::plan, py::call_guard<py::gil_scoped_release>())
      .def("emitting", &Room::emitting, py::call_guard<py::gil_scoped_release>())
      .def("render", call_of_room(&Room::render))
      .def("solve", call_of_room(&Room::solve))
      .def("form_factors", call_of_room(&Room::form_factors))
      .def("read_solution", [](const Room& room, const std::filesystem::path& file, const py::object& warning) {
        return listened(warning, py::none(), [&](const Listener& listener) { return room.read_solution(file, listener); });
      });
}

} // namespace

PYBIND11_MODULE(_meninas, module) {
  py::register_exception_translator([](std::exception_ptr failure) {
    try {
      if (failure)
        std::rethrow_exception(failure);
    } catch (const Error& error) {
      constexpr std::array names{"UsageError", "InputError", "OutputError", "Cancelled"};
      const py::object type = py::module_::import("meninas").attr(names[static_cast<std::size_t>(error.kind())]);
      // Names of files may be no UTF-8.
      const py::object text = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(error.what()));
      PyErr_SetObject(type.ptr(), text.ptr());
    }
  });
  define_picture(module);
  define_solution(module);
  define_factors(module);
  define_room(module);
  module.def("version", &version);
  py::module_::import("atexit").attr("register")(py::cpp_function([] {
    const py::gil_scoped_release unlocked;
    running_calls.end();
  }));
}
