#include <stdexcept>

#include <glissade/apps/commands/dynamixel_option.h>
#include <glissade/apps/usage.h>
#include <glissade/files/text.h>

namespace glissade::apps {

void add_dynamixel_option(CLI::App& command, DynamixelOption& option) {
  CLI::Option* config = command.add_option("--config", option.config, "YAML file with the servos of the glove");
  command.add_option("--preset", option.preset, "Known glove: " + files::joined(bridges::dynamixel_presets()))
      ->check(one_of(bridges::dynamixel_presets()))
      ->excludes(config);
  command.add_option("--baud", option.baud_rate, "Baud rate of the bus, instead of the one in the configuration");
}

bridges::DynamixelHand read_hand(const DynamixelOption& option) {
  if (option.config.empty() && option.preset.empty())
    throw std::invalid_argument(
        "--config is missing, the file with the servos of the glove; or --preset, a known glove: " +
        files::joined(bridges::dynamixel_presets()));
  bridges::DynamixelHand hand = bridges::read_dynamixel_hand(option.preset.empty() ? option.config : option.preset);
  if (option.baud_rate > 0) hand.baud_rate = option.baud_rate;
  bridges::validate(hand);
  return hand;
}

}  // namespace glissade::apps
