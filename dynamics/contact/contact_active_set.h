#pragma once
/// The exact solution of a small contact problem, once it is known which points push, stick and slip.

#include "dynamics/contact/contact_rows.h"
#include "dynamics/maths/envelope_matrix.h"

namespace stadion {

class ContactActiveSet {
public:
  ContactActiveSet(std::vector<SolverBody>& solverBodies, std::vector<SolverContact>& contacts,
                   const std::vector<ContactRow>& rows);

  /// Takes the active set from the present impulses, solves for it, and corrects it until it is consistent.
  /// False if it does not converge within so many multiplications; everything is then as it was.
  bool solve(double& work);

private:
  bool trySolving(double& work);
  enum class Kind : std::uint8_t { Open, Stick, Slip };
  /// An impulse in a contact's basis, and the velocity it is to bring about: `wanted` less `soft` times the
  /// impulse.
  struct Unknown {
    std::uint32_t contact;
    Vec3 reads, direction;
    double wanted, soft;
    bool normal;
    std::int32_t area = -1;    ///< area whose friction this impulse changes, too ...
    Vec3 also = Vec3::Zero();  ///< ... by this
  };
  static void add(ContactAxis& sum, const ContactRow& row, const Vec3& reads, const Vec3& direction);
  ContactAxis along(const Unknown& u) const;
  bool leavesFriction(std::size_t contact) const {
    return c_[contact].patch >= 0 || c_[contact].friction <= 0;
  }
  void listSlip(std::uint32_t contact);
  void listArea(std::uint32_t contact);
  void readActiveSet();
  void listUnknowns();
  bool isDense() const;
  double planRows();
  double changeBy(std::size_t row, std::size_t column) const;
  bool assemble();
  void solveFor(Eigen::VectorXd& r);
  double solveLinearly();
  bool correctActiveSet(bool singly);
  bool correctFriction(double largest);
  bool correctArea(std::size_t contact);
  Vec3 areaSlipOf(std::size_t contact) const;
  void setImpulse(std::size_t contact, const Vec3& impulse);
  Vec2 slipOf(std::size_t contact) const;

  std::vector<SolverBody>& m_;
  std::vector<SolverContact>& c_;
  const std::vector<ContactRow>& rows_;
  std::vector<Kind> kind_;
  std::vector<Unknown> unknowns_;
  std::vector<ContactAxis> axes_;  ///< axes of the unknowns
  std::vector<double> amount_;     ///< amount of each unknown that has been added
  std::vector<Vec3> flow_;         ///< slip of the areas that slip: friction goes against it
  /// Order of the contacts, along the line of bodies that they hold together.
  std::vector<std::uint32_t> order_;
  std::vector<std::size_t> firsts_;  ///< where each unknown's row begins
  EnvelopeMatrix narrow_;
  Eigen::MatrixXd K_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  std::vector<double> x_;
  Eigen::VectorXd r_;
  std::vector<Vec2> slip_;
  std::vector<Vec3> areaSlip_;
  std::vector<double> speed_;  ///< speed of points that slip, once the direction is nearly known [m/s]
  std::vector<double> over_;   ///< how much faster than its floor each open point parts
};

}  // namespace stadion
