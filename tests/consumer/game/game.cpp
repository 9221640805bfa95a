// The game loop in C++, with the implementation in the same file.
//   game_cpp LEVEL.slv
#define SIGHTLINE_RUNTIME_IMPLEMENTATION
#include <sightline_runtime.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

namespace {

// A level that was opened, and the memory to ask it.
class Level {
  public:
    explicit Level(const char *path) {
        std::ifstream file(path, std::ios::binary);
        bytes_.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
        status_ = sl_runtime_open(bytes_.data(), bytes_.size(), &runtime_);
        if (status_ != SL_RUNTIME_OK) return;
        scratch_.resize(sl_runtime_scratch_count(&runtime_));
        cells_.resize(runtime_.cell_count);
    }
    // The bytes are pointed into.
    Level(const Level &) = delete;
    Level &operator=(const Level &) = delete;

    sl_runtime_status status() const {
        return status_;
    }
    const sl_runtime &runtime() const {
        return runtime_;
    }

    // The cells that an eye sees; good until the next look.
    const std::vector<uint32_t> &look(const sl_runtime_view &view) {
        cells_.resize(runtime_.cell_count);
        cells_.resize(
            sl_runtime_look(&runtime_, &view, scratch_.data(), cells_.data(), runtime_.cell_count));
        return cells_;
    }

  private:
    std::vector<char> bytes_;
    sl_runtime runtime_;
    sl_runtime_status status_;
    std::vector<uint32_t> scratch_, cells_;
};

} // namespace

int main(int argc, char **argv) {
    if (argc != 2) return 1;
    Level level(argv[1]);
    if (level.status() != SL_RUNTIME_OK) {
        std::fprintf(stderr, "%s: %s\n", argv[1], sl_runtime_status_text(level.status()));
        return 1;
    }
    const sl_runtime &runtime = level.runtime();
    const double middle_x = (runtime.min_x + runtime.max_x) / 2;
    const double middle_y = (runtime.min_y + runtime.max_y) / 2;
    unsigned long drawn = 0, in_row = 0;
    // The player goes round the middle, looking ahead.
    for (int frame = 0; frame < 360; frame++) {
        const double angle = frame * 3.14159265358979 / 180;
        const double x = middle_x + std::cos(angle) * (runtime.max_x - middle_x) * 0.7;
        const double y = middle_y + std::sin(angle) * (runtime.max_y - middle_y) * 0.7;
        const uint32_t cell = sl_runtime_locate(&runtime, x, y);
        if (!sl_runtime_has_row(&runtime, cell)) continue;
        const sl_runtime_view view =
            sl_runtime_view_toward(x, y, -std::sin(angle), std::cos(angle), 1);
        for (uint32_t seen : level.look(view)) {
            if (!sl_runtime_can_see(&runtime, cell, seen)) return 1;
            drawn++;
        }
        in_row += sl_runtime_row_count(&runtime, cell);
    }
    std::printf("360 frames: %.1f cells drawn of %.1f in the rows\n", drawn / 360.0,
                in_row / 360.0);
    return drawn && drawn < in_row ? 0 : 1;
}
