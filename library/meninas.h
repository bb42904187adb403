// Meninas as a library: a room from a glTF file, its radiosity solution, pictures of it, and its form factors.
//
//   B = E + rho H,   H_i = sum_j T_ij B_j,   T_ij = sum over mirror worlds w of tau_w F^w_ij      (Eq. 1)
//
// B radiosity, E emission, H irradiance, W/m^2; rho the diffuse reflectance and tau the reflectance of a chain
// of mirrors, dimensionless; pictures are radiance, W/m^2/sr. Lengths are metres, +Y is up. Colours are linear
// red, green and blue, three numbers one after the other.
//
// Settings are the options of `meninas render` by their names without dashes, with the values that they have on
// the command line (docs/options.md): {{"quality", "draft"}, {"size", "640x480"}}. Settings of a call override those
// of its room; the others have the values of a preset. A call refuses its own settings that have no effect on it, and
// ignores such settings of its room. `threads` limits the threads of the process during the call, `error` and `time`
// choose the rest of a picture's settings, and `png` makes a picture for PNGs: edges get the rays that the command
// gives them.
//
// Objects are handles of immutable data: copies share it, and any thread may use them. Spans live as long as
// the object that they are of. Results are the same bits for any number of threads, and those of the commands for an
// EXR, with `png` for a PNG.
//
// Errors that a user can cause are thrown as Error, one line as the program says it. This header needs the standard
// library alone.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#define MENINAS_API __attribute__((visibility("default")))

namespace meninas {

/// `what()` is one line, FILE: WHERE: WHAT; empty parts are left out.
class MENINAS_API Error : public std::runtime_error {
public:
  enum class Kind {
    usage,    ///< a setting, name or shape that is not known, or does not go with others
    input,    ///< a file that cannot be read, or says nothing meaningful
    output,   ///< a file that cannot be written, or memory that is not there
    cancelled ///< Listener::progress said so
  };
  Error(Kind kind, const std::string& what);
  Error(const Error&) = default;
  ~Error() override;
  Kind kind() const { return kind_; }

private:
  Kind kind_;
};

/// One of a name that may be given several times stands as often; flags have no value.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Nothing of it changes a result; each may be empty.
struct Listener {
  std::function<void(const std::string&)> warning; ///< what a user has to know
  /// The stage and how much of it is done, 0 to 1, from any thread. False ends the call: it throws
  /// Error::Kind::cancelled.
  std::function<bool(const std::string& stage, double done)> progress;
};

using Colour = std::array<double, 3>;
using Point = std::array<double, 3>;

/// A picture with its layers: width times height pixels, row by row from the top, of three floats each.
class MENINAS_API RoomPicture {
public:
  /// EXR, HDR, PNG, JPEG, WebP or TIFF; displayed ones become linear.
  static RoomPicture read(const std::filesystem::path& file);

  int width() const;
  int height() const;
  std::span<const float> pixels() const;
  /// Layers that the settings asked for (`layers`), or that the file has.
  std::vector<std::string> layers() const;
  /// Three floats a pixel, likewise; of `depth` and `element` all three are the same.
  std::span<const float> layer(const std::string& name) const;
  /// Figures of the run as JSON (docs/stats.md), with the estimated error of the picture; empty of one that was read.
  std::string stats() const;

  /// .exr and .hdr linear, .png displayed. Settings go over those of the render: exposure, view-transform, depth,
  /// float.
  void write(const std::filesystem::path& file, const Settings& settings = {}) const;

  struct Impl;
  explicit RoomPicture(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

private:
  friend MENINAS_API struct PictureDistance distance(const RoomPicture& picture, const RoomPicture& reference);
  std::shared_ptr<const Impl> impl_;
};

/// The error of a picture against its reference (docs/commands.md, `diff`). PSNR in dB; RMSE, MAE and the maximum in
/// the unit of the pictures; relative MSE, SSIM and FLIP dimensionless, the last two as displayed.
struct PictureDistance {
  double rmse = 0.0, relmse = 0.0, mae = 0.0, psnr = 0.0, max_abs = 0.0, ssim = 0.0, flip = 0.0;
};
MENINAS_API PictureDistance distance(const RoomPicture& picture, const RoomPicture& reference);

/// The irradiance at a point on the side of a normal, W/m^2.
struct Arriving {
  Colour total{}, direct{}, by_mirrors{}; ///< `direct`: no diffuse surface has reflected it
  bool inside = false;                    ///< the point is inside of something: no light is there
};
struct MeasuringPoint {
  Point position{};
  Point normal{0.0, 1.0, 0.0};
};

/// Pass one: the irradiance of all diffuse surfaces.
class MENINAS_API RoomSolution {
public:
  /// A glTF that any viewer shows, and that Room::read_solution and `meninas render --solution` take.
  void write(const std::filesystem::path& file) const;
  /// Pass two: the picture of a camera. Settings of pass one have no effect.
  RoomPicture render(const Settings& settings = {}, const Listener& listener = {}) const;
  /// The same room with lamps so many times as bright, exact by linearity. Needs a solution with the setting `by-lamp`.
  RoomSolution relit(const std::vector<std::pair<std::string, Colour>>& factors) const;
  /// Irradiance anywhere in the room, by eight times the rays of a vertex. Points are within 1e6 m.
  std::vector<Arriving> irradiance_at(std::span<const MeasuringPoint> points, const Listener& listener = {}) const;

  /// The field, by vertex: three floats each, metres and W/m^2. Between vertices it is bilinear in quads, linear in
  /// triangles.
  std::span<const float> vertices() const;
  std::span<const float> irradiance() const;
  /// By element four vertices; a triangle repeats its third.
  std::span<const std::uint32_t> elements() const;
  /// By element its node, a place in Room::nodes(), and its area, m^2.
  std::span<const std::uint32_t> node_of_element() const;
  std::span<const double> area() const;
  /// Figures of pass one as JSON (docs/stats.md).
  std::string stats() const;

  struct Impl;
  explicit RoomSolution(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

private:
  std::shared_ptr<const Impl> impl_;
};

/// T of Eq. 1 between the elements of a uniform mesh, as rows without zeros (CSR), and what the elements are.
/// A row sums to at most 1, in a closed room without mirrors to 1; light that meets more mirrors than `mirror-depth`
/// allows is lost. Form factors F are those of one channel where no mirror is coloured.
class MENINAS_API RoomFactors {
public:
  std::size_t size() const;
  int channels() const; ///< 1, or 3 where mirrors are coloured
  std::span<const std::uint64_t> row_begin() const; ///< one more than rows
  std::span<const std::uint32_t> columns() const;
  std::span<const float> weights() const; ///< entry k, channel c at [k * channels() + c]
  std::span<const double> area() const;   ///< m^2
  std::span<const float> centre() const, normal() const; ///< three each
  std::span<const double> reflectance() const, emission() const; ///< three each; emission in W/m^2
  std::span<const std::uint32_t> node_of_element() const; ///< places in Room::nodes()

  struct Solved {
    std::vector<double> radiosity; ///< B, three each, W/m^2
    int iterations = 0;
    double residual = 0.0, error_bound = 0.0; ///< relative, in the maximum norm; infinite without a bound
    bool converged = false;
  };
  /// B = E + rho T B of the elements, by the settings `solver`, `tolerance` and `steps`. E three each, W/m^2; of the
  /// scene where it is empty. Lights that are no faces have none. `solver` direct tells no progress and is not ended.
  Solved solve(std::span<const double> emission = {}, const Settings& settings = {}, const Listener& listener = {}) const;

  struct Impl;
  explicit RoomFactors(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

private:
  std::shared_ptr<const Impl> impl_;
};

/// A scene as its file says it.
class MENINAS_API Room {
public:
  /// Settings hold for all calls. The state of the file, its units and the environment can be set here only.
  explicit Room(const std::filesystem::path& file, const Settings& settings = {}, const Listener& listener = {});

  std::vector<std::string> cameras() const;
  std::vector<std::string> nodes() const;
  std::vector<std::string> lamps() const; ///< as the setting `lamp` names them
  /// The contents of the room, the modelled transport and the oddities, as JSON (`meninas plan --json`).
  std::string plan(const Settings& settings = {}) const;
  /// The same room where all faces of these nodes emit E, W/m^2, in place of their emission in the file; 0 is dark.
  /// A solution of it belongs to it, not to the file.
  Room emitting(const std::vector<std::pair<std::string, Colour>>& nodes) const;

  /// Both passes for one camera, as `meninas render` does them; also by `mode` reference, `error` and `time`.
  RoomPicture render(const Settings& settings = {}, const Listener& listener = {}) const;
  /// Pass one for any number of pictures, as `meninas solve`. `by-lamp` (node or material) tells lamps apart.
  RoomSolution solve(const Settings& settings = {}, const Listener& listener = {}) const;
  RoomSolution read_solution(const std::filesystem::path& file, const Listener& listener = {}) const;
  /// Settings: form-factors, rays, hemicube-resolution, elements, element-size, mirror-depth (0: without mirrors),
  /// seed, quality, lamp.
  RoomFactors form_factors(const Settings& settings = {}, const Listener& listener = {}) const;

  struct Impl;

private:
  explicit Room(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// "0.2.0"
MENINAS_API std::string version();

} // namespace meninas
