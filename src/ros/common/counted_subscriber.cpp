#include "spring_workbench/ros/common/counted_subscriber.h"

#include <algorithm>
#include <atomic>
#include <boost/make_shared.hpp>
#include <mutex>
#include <typeinfo>
#include <vector>

namespace spring_workbench::ros_common {
namespace {

/// Ignores messages of a type. roscpp hands a message of its own process to the subscribers of its type first, and to
/// others later; what all subscribers of a type are given, the first of them reads.
class Unread : public ros::SubscriptionCallbackHelper {
 public:
  explicit Unread(const std::type_info& type) : type_(type) {}
  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams&) override { return nullptr; }
  void call(ros::SubscriptionCallbackHelperCallParams&) override {}
  const std::type_info& getTypeInfo() override { return type_; }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  const std::type_info& type_;
};

}  // namespace

/// roscpp hands each message that arrives to the subscribers of its topic and type, in their order and under one lock.
/// It adds a callback to a subscriber's callback queue unless the queue of messages was full. So a second subscriber,
/// which is never full, sees which messages made the first one lose another.
class CountedSubscriber::Counter {
 public:
  explicit Counter(ros::CallbackQueueInterface& queue) : counted_(*this, queue), arrivals_(*this) {}

  ros::CallbackQueueInterface* counted() { return &counted_; }
  ros::CallbackQueueInterface* arrivals() { return &arrivals_; }
  std::size_t lost() const { return lost_; }

 private:
  struct Counted : ros::CallbackQueueInterface {
    Counted(Counter& counter_of, ros::CallbackQueueInterface& to) : counter(counter_of), queue(to) {}
    void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override {
      counter.taken_ = true;
      queue.addCallback(callback, owner);
    }
    void removeByID(std::uint64_t owner) override { queue.removeByID(owner); }
    Counter& counter;
    ros::CallbackQueueInterface& queue;
  };
  struct Arrivals : ros::CallbackQueueInterface {
    explicit Arrivals(Counter& counter_of) : counter(counter_of) {}
    void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t) override {
      if (counter.began_ && !counter.taken_) ++counter.lost_;
      counter.began_ = true;  // the first message may have come between the two subscriptions
      counter.taken_ = false;
      callback->call();  // takes it out of the queue
    }
    void removeByID(std::uint64_t) override {}
    Counter& counter;
  };

  Counted counted_;
  Arrivals arrivals_;
  bool began_ = false, taken_ = false;
  std::atomic<std::size_t> lost_{0};
};

namespace {

struct Counters {
  std::mutex mutex;
  std::multimap<std::string, std::shared_ptr<const CountedSubscriber::Counter>> by_topic;
};

Counters& counters() {
  static Counters all;
  return all;
}

}  // namespace

CountedSubscriber::CountedSubscriber(ros::NodeHandle& node, ros::SubscribeOptions options)
    : counter_(std::make_shared<Counter>(*node.getCallbackQueue())) {
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  options.callback_queue = counter_->counted();
  subscriber_ = node.subscribe(options);
  options.helper = boost::make_shared<Unread>(options.helper->getTypeInfo());
  options.callback_queue = counter_->arrivals();
  arrivals_ = node.subscribe(options);
  const std::lock_guard<std::mutex> lock(counters().mutex);
  counters().by_topic.emplace(topic(), counter_);
}

std::map<std::string, std::size_t> CountedSubscriber::lost() {
  std::map<std::string, std::size_t> result;
  const std::lock_guard<std::mutex> lock(counters().mutex);
  for (const auto& [topic, counter] : counters().by_topic) result[topic] = std::max(result[topic], counter->lost());
  return result;
}

}  // namespace spring_workbench::ros_common
