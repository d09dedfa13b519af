// The same in C++.
#include <cstdio>
#include <memory>
#include <orzo.h>
#include <vector>

int main(int argc, char **argv)
{
    OrzoSim *opened = nullptr;
    if (argc != 2 || orzo_open(&opened, argv[1]) != ORZO_OK) {
        std::fprintf(stderr, "%s\n", orzo_error());
        return 1;
    }
    std::unique_ptr<OrzoSim, decltype(&orzo_close)> sim(opened, orzo_close);
    if (orzo_run_to(sim.get(), orzo_end(sim.get())) != ORZO_OK) {
        return 1;
    }
    std::vector<double> place(3 * orzo_count(sim.get()));
    if (orzo_read(sim.get(), ORZO_POSITION, place.data(), place.size()) != ORZO_OK) {
        return 1;
    }
    for (std::size_t i = 0; i < place.size(); i += 3) {
        std::printf("%.17g,%.17g,%.17g\n", place[i], place[i + 1], place[i + 2]);
    }
}
