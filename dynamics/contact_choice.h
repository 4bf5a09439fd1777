#pragma once
/// The exact solution of a small contact problem, once it is known which points push, stick and slip.

#include "dynamics/contact_rows.h"

namespace stadion {

class ContactChoice {
public:
  ContactChoice(std::vector<Mobile>& mobiles, std::vector<SolverContact>& contacts,
                const std::vector<ContactRow>& rows)
      : m_(mobiles), c_(contacts), rows_(rows) {}

  /// Reads the choice off the present impulses, solves for it and mends it until every point agrees. False if
  /// it does not settle within so many multiplications; everything is then as it was.
  bool settle(double& work);

private:
  bool attempt(double& work);
  enum class Kind : std::uint8_t { Open, Stick, Slip };
  /// An impulse in a contact's basis, and the velocity it is to bring about: `wanted` less `soft` times the
  /// impulse.
  struct Unknown {
    std::uint32_t contact;
    Vec3 reads, direction;
    double wanted, soft;
    bool normal;
  };
  static ContactAxis along(const ContactRow& row, const Unknown& u);
  void listSlip(std::uint32_t contact);
  void read();
  void list();
  void assemble();
  double solve();
  bool mend(bool singly);
  bool mendFriction(double largest);
  void put(std::size_t contact, const Vec3& impulse);
  Vec2 slipOf(std::size_t contact) const;

  std::vector<Mobile>& m_;
  std::vector<SolverContact>& c_;
  const std::vector<ContactRow>& rows_;
  std::vector<Kind> kind_;
  std::vector<Unknown> unknowns_;
  std::vector<ContactAxis> axes_;  ///< of the unknowns
  Eigen::MatrixXd K_;
  Eigen::VectorXd r_;
  std::vector<Vec2> slip_;
  std::vector<double> speed_;  ///< of points that slip, once the direction is nearly known [m/s]
  std::vector<double> over_;   ///< how much faster than its floor each open point parts
};

}  // namespace stadion
