#include "lv/immersed/coupling.hpp"

#include "lv/base/parallel.hpp"
#include "lv/immersed/quadrature_coupling.hpp"

namespace lv::immersed {
namespace {

class NodalCoupling final : public Coupling {
 public:
  explicit NodalCoupling(const Transfer& transfer) : transfer_(transfer) {}

  void spread(std::span<const Vec3> positions, std::span<const Vec3> forces,
              fluid::FaceField& force) const override {
    for (std::size_t a = 0; a < positions.size(); ++a)
      if (transfer_.reaches(positions[a].z(), positions[a].z()))
        transfer_.spread(positions[a], forces[a], force);
  }

  void interpolate(const fluid::FaceField& velocity, std::span<const Vec3> positions,
                   std::span<Vec3> velocities) const override {
    for (std::size_t a = 0; a < positions.size(); ++a)
      velocities[a] = transfer_.owns(positions[a]) ? transfer_.interpolate(velocity, positions[a])
                                                   : Vec3::Zero().eval();
    parallel::sum({velocities.data()->data(), 3 * velocities.size()});
  }

 private:
  Transfer transfer_;
};

}  // namespace

std::unique_ptr<Coupling> make_coupling(const CouplingParameters& parameters,
                                        const mesh::Mesh& mesh, const fluid::Grid& grid,
                                        const fluid::Slab& slab) {
  const Transfer transfer(grid, slab, parameters.kernel);
  if (parameters.kind == CouplingKind::nodal)
    return std::make_unique<NodalCoupling>(transfer);
  return std::make_unique<QuadratureCoupling>(mesh, transfer, grid.spacing.minCoeff(),
                                              parameters.points_per_cell);
}

}  // namespace lv::immersed
