#include <glissade/apps/view/contact_wrench.h>
#include <glissade/contact/spring.h>

namespace glissade::apps {

contact::Wrench contact_wrench(const contact::SlidingResult& result, const Eigen::Vector3d& p_Vref) {
  const Eigen::Vector3d p_Wref = result.X_WV_of_contacts * p_Vref;
  contact::Wrench sum;
  for (const contact::Contact& contact : result.contacts) {
    const Eigen::Vector3d f_W = contact.force * contact.n_W + contact.friction_W;
    sum.f += f_W;
    sum.t += (contact.p_W - p_Wref).cross(f_W);
  }
  return sum;
}

}  // namespace glissade::apps
